#include "expr/compile.h"
#include "model/instance.h"

namespace gainsmith::model {

namespace {

constexpr expr::Shape kScalar{};

void check_component(const Component& part, const expr::Scope& scope) {
  for (const Named& output : part.outputs) expr::compile(output.value, scope);
  for (const auto* map : {&part.flow, &part.jump})
    for (const Named& entry : *map)
      expr::compile(entry.value, scope, scope.symbols.at(entry.name).shape);
}

void check_requirements(const Instance& instance) {
  const expr::Scope design = instance.design_scope();
  for (const Requirement& requirement : instance.method->require) {
    expr::Scope scope = design;
    for (const Forall& forall : requirement.forall) {
      for (const expr::Expression& point : forall.points)
        expr::compile(point, instance.scope, kScalar);
      scope.symbols[forall.variable] = {kScalar, std::nullopt};
    }
    expr::compile_relations(requirement.that, scope);
  }
  if (instance.method->minimize) expr::compile(*instance.method->minimize, design, kScalar);
}

void check_campaign(const Instance& instance, const expr::Scope& scope) {
  const Campaign& campaign = instance.problem->campaign;
  if (campaign.horizon) expr::compile(*campaign.horizon, scope, kScalar);
  if (campaign.first) expr::compile(*campaign.first, scope, kScalar);
  for (const SamplingLaw& law : campaign.sampling)
    for (const expr::Expression& value : law.values) expr::compile(value, scope, kScalar);
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
  }
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
  const expr::Scope scope = instance.simulation_scope(gain_shapes(instance));
  check_component(instance.method->plant, scope);
  check_component(instance.method->observer, scope);
  for (const Named& signal : instance.method->signals) expr::compile(signal.value, scope);
  if (const auto& timer = instance.method->timer)
    for (const expr::Expression* bound :
         {&timer->low, &timer->high, &timer->first_low, &timer->first_high})
      expr::compile(*bound, instance.scope, kScalar);
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
