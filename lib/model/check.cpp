#include <set>

#include "base/number.h"
#include "expr/compile.h"
#include "model/instance.h"

namespace gainsmith::model {

namespace {

constexpr expr::Shape kScalar{};

void check_component(const Component& part, const expr::Scope& scope) {
  for (const Declaration& state : part.states)
    if (state.fallback) expr::compile(*state.fallback, scope, scope.symbols.at(state.name).shape);
  for (const Named& output : part.outputs) expr::compile(output.value, scope);
  for (const auto* map : {&part.flow, &part.jump})
    for (const Named& entry : *map)
      expr::compile(entry.value, scope, scope.symbols.at(entry.name).shape);
}

/// The shape that all elements of a `forall` have; InputError when they differ.
expr::Shape shape_of(const Forall& forall, const expr::Scope& scope) {
  if (forall.over == Forall::Over::interval) {
    for (const expr::Expression& end : forall.points) expr::compile(end, scope, kScalar);
    return kScalar;
  }
  const expr::Shape first = expr::compile(forall.points.front(), scope).shape();
  for (const expr::Expression& element : forall.points) {
    const expr::Shape shape = expr::compile(element, scope).shape();
    if (shape != first)
      throw InputError(element.place(*element.root),
                       "the elements of " + forall.variable + " must have one shape; found " +
                           to_string(first) + " and " + to_string(shape));
  }
  return first;
}

void check_requirements(const Instance& instance) {
  const expr::Scope design = instance.design_scope();
  for (const Requirement& requirement : instance.method->require) {
    expr::Scope scope = design;
    for (const Forall& forall : requirement.forall) {
      scope.symbols[forall.variable] = {shape_of(forall, instance.scope), std::nullopt};
    }
    expr::compile_relations(requirement.that, scope);
  }
  if (instance.method->minimize) expr::compile(*instance.method->minimize, design, kScalar);
}

/// The value of a scalar that uses data and parameters alone; none when it uses gains.
std::optional<double> known_scalar(const Instance& instance, const expr::Expression& expression,
                                   const expr::Scope& scope) {
  const numbers::Values values = instance.known_values();
  const expr::Program program = expr::compile(expression, scope, kScalar);
  for (const expr::Input& input : program.inputs)
    if (!values.contains(input.name)) return std::nullopt;
  return numbers::evaluate(program, values)(0, 0);
}

/// InputError when the value is known and outside [low, high].
void check_within(const Instance& instance, const expr::Expression& expression,
                  const expr::Scope& scope, const expr::Expression& low,
                  const expr::Expression& high, const std::string& what) {
  const auto value = known_scalar(instance, expression, scope);
  const auto least = known_scalar(instance, low, scope);
  const auto most = known_scalar(instance, high, scope);
  if (!value || !least || !most || (*value >= *least && *value <= *most)) return;
  throw InputError(
      expression.place(*expression.root),
      what + " " + brief(*value) + " is outside [" + brief(*least) + ", " + brief(*most) + "]");
}

void check_box(const Instance& instance, const InitialValue& initial, const expr::Scope& scope) {
  const numbers::Values values = instance.known_values();
  std::vector<numbers::Matrix> ends;
  for (const Value& value : initial.values) {
    const expr::Program program = compile_value(value, scope, std::nullopt);
    for (const expr::Input& input : program.inputs)
      if (!values.contains(input.name)) return;
    ends.push_back(numbers::evaluate(program, values));
  }
  const bool same = ends[0].rows() == ends[1].rows() && ends[0].cols() == ends[1].cols();
  if (same && (ends[0].array() > ends[1].array()).any())
    throw InputError(initial.values[1].place,
                     "the box of " + initial.state + " has its low end above its high end");
}

void check_campaign(const Instance& instance, const expr::Scope& scope) {
  const Campaign& campaign = instance.problem->campaign;
  const auto& timer = instance.method->timer;
  if (campaign.horizon) {
    const auto horizon = known_scalar(instance, *campaign.horizon, scope);
    if (horizon && !(*horizon > 0))
      throw InputError(campaign.horizon->place(*campaign.horizon->root),
                       "the horizon must be positive, not " + brief(*horizon));
  }
  if (campaign.first) {
    known_scalar(instance, *campaign.first, scope);
    if (timer)
      check_within(instance, *campaign.first, scope, timer->first_low, timer->first_high,
                   "the first timer value");
  }
  for (const SamplingLaw& law : campaign.sampling) {
    for (const expr::Expression& value : law.values) {
      known_scalar(instance, value, scope);
      if (timer)
        check_within(instance, value, scope, timer->low, timer->high, "the sampling interval");
    }
  }
  for (const InitialValue& initial : campaign.initial) {
    const expr::Shape state = scope.symbols.at(initial.state).shape;
    for (const Value& value : initial.values) {
      if (initial.kind != InitialValue::Kind::box) {
        compile_value(value, scope, state);
        continue;
      }
      const expr::Shape shape = compile_value(value, scope, std::nullopt).shape();
      const bool turned = value.flat && shape == expr::Shape{state.cols, state.rows};
      if (shape != state && !shape.is_scalar() && !turned)
        throw InputError(value.place, "a bound of the state " + initial.state +
                                          " must be a number or " + to_string(state) + "; found " +
                                          to_string(shape));
    }
    if (initial.kind == InitialValue::Kind::box) check_box(instance, initial, scope);
  }
}

/// Each scalar is searched in one way.
void refuse_repetition(const Search& search) {
  std::set<std::string> names;
  if (search.extreme) names.insert(search.extreme->name);
  for (const ScalarRange& range : search.over)
    if (!names.insert(range.name).second)
      throw InputError(range.place, "'" + range.name + "' is searched already");
}

void check_search(const Instance& instance) {
  const numbers::Values values = instance.known_values();
  const auto check = [&](const ScalarRange& range) { ends_of(range, instance.scope, values); };
  for (const ScalarRange& range : instance.problem->negotiable) check(range);
  for (const ScalarRange& range : open_parameters(*instance.problem)) check(range);
  const auto& search = instance.problem->search;
  if (!search) return;
  refuse_repetition(*search);
  if (search->extreme) check(*search->extreme);
  for (const ScalarRange& range : search->over) check(range);
  if (!search->minimize) return;
  expr::Scope scope = instance.simulation_scope();
  scope.symbols["objective"] = {kScalar, std::nullopt};
  expr::compile(*search->minimize, scope, kScalar);
}

void check_claims(const Instance& instance, const expr::Scope& scope) {
  for (const Claim& claim : instance.method->claims) {
    expr::compile(claim.value, scope, kScalar);
    for (const auto& part : {claim.flow_cost, claim.jump_cost, claim.factor})
      if (part) expr::compile(*part, scope, kScalar);
  }
}

}  // namespace

void check_everything(const Instance& instance) {
  check_requirements(instance);
  const expr::Scope scope = instance.simulation_scope();
  check_component(instance.method->plant, scope);
  check_component(instance.method->observer, scope);
  for (const Named& value : instance.method->report) expr::compile(value.value, scope);
  for (const Named& signal : instance.method->signals) expr::compile(signal.value, scope);
  if (const auto& timer = instance.method->timer)
    for (const expr::Expression* bound :
         {&timer->low, &timer->high, &timer->first_low, &timer->first_high})
      expr::compile(*bound, instance.scope, kScalar);
  check_search(instance);
  check_claims(instance, scope);
  check_campaign(instance, scope);
  if (!instance.problem->expect) return;
  expr::Scope expected = scope;
  expected.symbols["objective"] = {kScalar, std::nullopt};
  for (const ExpectedValue& value : instance.problem->expect->values) {
    const expr::Shape shape = expr::compile(value.what, expected).shape();
    compile_value(value.value, instance.scope, shape);
  }
}

}  // namespace gainsmith::model
