#include "model/instance.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/nearest.h"
#include "base/number.h"
#include "expr/compile.h"
#include "model/structure.h"

namespace gainsmith::model {

namespace {

template <class Item>
const Item* find_named(const std::vector<Item>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

bool is_proper_column(expr::Shape shape) { return shape.cols == 1 && shape.rows > 1; }

/// A flat list is a row; where a column is declared it is turned.
expr::Expression oriented(const Value& value, bool column) {
  if (!value.flat || !column) return value.value;
  auto turned = std::make_shared<expr::Node>();
  turned->kind = expr::NodeKind::transpose;
  turned->begin = value.value.root->begin;
  turned->end = value.value.root->end;
  turned->children = {value.value.root};
  return {value.value.text, turned};
}

std::string declared(const Declaration& declaration, const Dimensions& dimensions) {
  std::string text = declaration.shape.text;
  std::string known;
  for (const auto& part : {declaration.shape.rows, declaration.shape.cols}) {
    if (!part) continue;
    for (const std::string& name : names_in(*part)) {
      const auto found = dimensions.find(name);
      const std::string fact =
          found == dimensions.end() ? "" : name + " = " + std::to_string(found->second);
      if (!fact.empty() && known.find(fact) == std::string::npos)
        known += (known.empty() ? "" : ", ") + fact;
    }
  }
  return text + (known.empty() ? "" : " (" + known + ")");
}

class Builder {
 public:
  Builder(const Problem& problem, const Overrides& overrides) {
    instance_.problem = &problem;
    instance_.method = problem.method.get();
    instance_.overrides = overrides;
  }

  Instance build() {
    refuse_unknown_names();
    check_overrides();
    for (const Declaration& datum : method().data) add_datum(datum);
    for (const Declaration& datum : method().data) check_shape(datum);
    for (const Parameter& parameter : method().parameters) add_parameter(parameter);
    for (const Let& let : method().let)
      instance_.scope.definitions[let.signature.name] = {let.signature.parameters, let.body};
    for (const Component* part : {&method().plant, &method().observer})
      for (const Named& output : part->outputs)
        instance_.scope.definitions[output.name] = {{}, output.value};
    for (const Named& signal : method().signals)
      instance_.scope.definitions[signal.name] = {{}, signal.value};
    for (const Named& assumption : method().assume) check_assumption(assumption);
    for (const UnknownDeclaration& unknown : method().unknowns) add_unknown(unknown);
    for (const Component* part : {&method().plant, &method().observer})
      for (const Declaration& state : part->states)
        instance_.states.emplace_back(state.name, known_shape(state, "state"));
    return std::move(instance_);
  }

 private:
  const Problem& problem() const { return *instance_.problem; }
  const Method& method() const { return *instance_.method; }

  void refuse_unknown_names() const {
    const auto data = names_of(method().data);
    const auto parameters = names_of(method().parameters);
    const auto refuse = [&](const std::vector<Value>& values, const std::vector<std::string>& known,
                            const std::vector<std::string>& elsewhere, const char* what,
                            const char* other) {
      for (const Value& value : values) {
        if (std::find(known.begin(), known.end(), value.name) != known.end()) continue;
        const bool misplaced =
            std::find(elsewhere.begin(), elsewhere.end(), value.name) != elsewhere.end();
        throw InputError(value.place, "the method " + method().name + " has no " + what + " '" +
                                          value.name + "'" +
                                          (misplaced ? "; it is one of its " + std::string(other)
                                                     : suggestion(value.name, known)));
      }
    };
    refuse(problem().data, data, parameters, "datum", "parameters");
    refuse(problem().parameters, parameters, data, "parameter", "data");
  }

  void check_overrides() const {
    for (const auto& [name, value] : instance_.overrides) {
      check_scalar_name(method(), name, {problem().file});
      if (!std::isfinite(value))
        throw InputError({problem().file}, name + ": expected a finite number");
    }
  }

  /// The override of a scalar.
  std::optional<numbers::Matrix> overridden(const std::string& name) const {
    const auto found = instance_.overrides.find(name);
    if (found == instance_.overrides.end()) return std::nullopt;
    return numbers::Matrix::Constant(1, 1, found->second);
  }

  /// The range in which the problem looks for a scalar.
  const ScalarRange* find_searched(const std::string& name) const {
    if (!problem().search) return nullptr;
    const Search& search = *problem().search;
    if (search.extreme && search.extreme->name == name) return &*search.extreme;
    return find_named(search.over, name);
  }

  /// Where the search for a scalar begins.
  numbers::Matrix first_value(const ScalarRange& range) const {
    const auto [low, high] = ends_of(range, scope_with_dimensions(), instance_.known_values());
    const auto& search = problem().search;
    const bool smallest =
        search && !search->largest && search->extreme && search->extreme->name == range.name;
    return numbers::Matrix::Constant(1, 1, smallest ? high : low);
  }

  void add_datum(const Declaration& datum) {
    if (const auto value = overridden(datum.name))
      return define(datum.name, *value, instance_.data);
    const Value* given = find_named(problem().data, datum.name);
    const ScalarRange* searched = find_searched(datum.name);
    if (given == nullptr && !datum.fallback && searched != nullptr)
      return define(datum.name, first_value(*searched), instance_.data);
    if (given == nullptr && !datum.fallback)
      throw InputError({problem().file}, "the datum " + datum.name + " (" + datum.shape.text +
                                             ") of the method " + method().name +
                                             " is missing under 'data'");
    const Value value = given ? *given : Value{datum.name, *datum.fallback, false, datum.place};
    const auto expected = resolve(datum.shape, instance_.dimensions);
    const bool column = datum.shape.is_column() || (expected && is_proper_column(*expected));
    const auto program = expr::compile(oriented(value, column), scope_with_dimensions(),
                                       free_size(value) ? expected : std::nullopt);
    if (!learn(datum.shape, program.shape(), instance_.dimensions))
      throw InputError(value.place, "the datum " + datum.name + " is declared " +
                                        declared(datum, instance_.dimensions) + "; found " +
                                        to_string(program.shape()));
    numbers::Matrix matrix = numbers::evaluate(program, instance_.data);
    enforce_structure(datum, value, matrix);
    define(datum.name, matrix, instance_.data);
  }

  /// A size such as n + p may have been unknown when the datum was read.
  void check_shape(const Declaration& datum) {
    const expr::Shape shape = instance_.scope.symbols.at(datum.name).shape;
    const Value* given = find_named(problem().data, datum.name);
    // A default may be empty: no output at jumps, nothing that is hidden.
    const bool empty = shape.size() == 0 && given != nullptr;
    if (learn(datum.shape, shape, instance_.dimensions) && !empty) return;
    throw InputError(given ? given->place : datum.place,
                     "the datum " + datum.name + " is declared " +
                         declared(datum, instance_.dimensions) + "; found " + to_string(shape));
  }

  /// Whether the expression may take its size from its place: a bare number or a multiple of I.
  static bool free_size(const Value& value) {
    const auto names = names_in(value.value);
    return names.contains("I") || value.value.root->kind == expr::NodeKind::number;
  }

  void add_parameter(const Parameter& parameter) {
    if (const auto value = overridden(parameter.name))
      return define(parameter.name, *value, instance_.parameters);
    const Value* given = find_named(problem().parameters, parameter.name);
    const ScalarRange* searched = find_searched(parameter.name);
    if (searched == nullptr && parameter.search) searched = &*parameter.search;
    if (given == nullptr && !parameter.fallback && searched != nullptr)
      return define(parameter.name, first_value(*searched), instance_.parameters);
    if (given == nullptr && !parameter.fallback)
      throw InputError({problem().file}, "the parameter " + parameter.name + " of the method " +
                                             method().name +
                                             " has no default and is missing under 'parameters'");
    const expr::Expression& expression = given ? given->value : *parameter.fallback;
    const auto program = expr::compile(expression, scope_with_dimensions(), expr::Shape{});
    define(parameter.name, numbers::evaluate(program, instance_.known_values()), instance_.parameters);
  }

  expr::Scope scope_with_dimensions() const {
    expr::Scope scope = instance_.scope;
    scope.dimensions = instance_.dimensions;
    return scope;
  }

  void define(const std::string& name, const numbers::Matrix& matrix, numbers::Values& values) {
    const expr::Shape shape{static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols())};
    instance_.scope.symbols[name] = {shape, matrix};
    instance_.scope.dimensions = instance_.dimensions;
    values[name] = matrix;
  }

  void check_assumption(const Named& assumption) const {
    const numbers::Values values = instance_.known_values();
    for (const auto& relation : compile_relations(assumption.value, instance_.scope)) {
      const numbers::Matrix difference = numbers::evaluate(relation.difference, values);
      if (difference.size() == 1 &&
          (relation.strict ? difference(0, 0) > 0 : difference(0, 0) >= 0))
        continue;
      Place place = {problem().file};
      std::string found;
      for (const std::string& name : names_in(assumption.value)) {
        const auto value = values.find(name);
        if (value == values.end() || value->second.size() != 1) continue;
        found += (found.empty() ? "" : ", ") + name + " = " + brief(value->second(0, 0));
        for (const auto* list : {&problem().data, &problem().parameters})
          if (const Value* given = find_named(*list, name)) place = given->place;
      }
      throw InputError(
          place, (found.empty() ? "" : found + ": ") + "expected " + assumption.value.text->str());
    }
  }

  void add_unknown(const UnknownDeclaration& unknown) {
    const expr::Shape shape = known_shape(unknown, "unknown");
    const Structure structure = unknown.shape.structure;
    if (unknown.variable.empty()) {
      instance_.unknowns.push_back({unknown.name, shape, structure});
      return;
    }
    const UnknownFunction function{unknown.name, unknown.variable, shape, structure, {},
                                   {},           unknown.place};
    add_polynomial(instance_, function, degree_of(unknown));
  }

  int degree_of(const UnknownDeclaration& unknown) const {
    constexpr int kLargest = 30;
    if (!unknown.degree) return 0;
    const double degree =
        scalar_value(*unknown.degree, scope_with_dimensions(), instance_.known_values());
    if (!(degree >= 0 && degree <= kLargest) || std::trunc(degree) != degree)
      throw InputError(unknown.degree->place(*unknown.degree->root),
                       "the degree of " + unknown.name + " must be a whole number from 0 to " +
                           std::to_string(kLargest) + ", not " + brief(degree));
    return static_cast<int>(degree);
  }

  expr::Shape known_shape(const Declaration& declaration, const char* what) const {
    if (const auto shape = resolve(declaration.shape, instance_.dimensions)) return *shape;
    throw InputError(declaration.place, "the size of the " + std::string(what) + " " +
                                            declaration.name + " (" + declaration.shape.text +
                                            ") does not follow from the data");
  }

  Instance instance_;
};

}  // namespace

Instance make_instance(const Problem& problem, const Overrides& overrides) {
  return Builder(problem, overrides).build();
}

std::pair<double, double> ends_of(const ScalarRange& range, const expr::Scope& scope,
                                  const numbers::Values& values) {
  const double low = scalar_value(range.low, scope, values);
  const double high = scalar_value(range.high, scope, values);
  if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
    throw InputError(range.place, range.name +
                                      ": expected a range [low, high] with low < high, found [" +
                                      brief(low) + ", " + brief(high) + "]");
  return {low, high};
}

std::vector<ScalarRange> open_parameters(const Problem& problem) {
  std::vector<ScalarRange> open;
  for (const Parameter& parameter : problem.method->parameters)
    if (parameter.search && find_named(problem.parameters, parameter.name) == nullptr)
      open.push_back(*parameter.search);
  return open;
}

std::vector<std::string> scalar_names(const Method& method) {
  std::vector<std::string> names;
  for (const Declaration& datum : method.data)
    if (datum.shape.structure == Structure::scalar) names.push_back(datum.name);
  for (const Parameter& parameter : method.parameters) names.push_back(parameter.name);
  return names;
}

void check_scalar_name(const Method& method, const std::string& name, const Place& place) {
  const std::vector<std::string> known = scalar_names(method);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  if (const Declaration* datum = find_named(method.data, name))
    throw InputError(place, "'" + name + "' is a matrix (" + datum->shape.text +
                                "); expected a scalar datum or parameter");
  throw InputError(place, "the method " + method.name + " has no scalar datum or parameter '" +
                              name + "'" + suggestion(name, known));
}

numbers::Values Instance::known_values() const {
  numbers::Values values = data;
  values.insert(parameters.begin(), parameters.end());
  return values;
}

expr::Scope Instance::design_scope() const {
  expr::Scope result = scope;
  for (const UnknownMatrix& unknown : unknowns)
    result.symbols[unknown.name] = {unknown.shape, std::nullopt};
  return result;
}

expr::Scope Instance::simulation_scope() const {
  expr::Scope result = design_scope();
  for (const auto& [name, shape] : gain_shapes(*this))
    if (!result.symbols.contains(name)) result.symbols[name] = {shape, std::nullopt};
  for (const Gain& gain : method->gains) {
    if (gain.variable.empty()) continue;
    result.symbols.erase(gain.name);
    result.definitions[gain.name] = {{gain.variable}, gain.value};
  }
  for (const auto& [name, shape] : states) result.symbols[name] = {shape, std::nullopt};
  if (method->timer) result.symbols[method->timer->name] = {expr::Shape{}, std::nullopt};
  return result;
}

expr::Program compile_gain(const Gain& gain, expr::Scope scope) {
  if (!gain.variable.empty()) scope.symbols[gain.variable] = {expr::Shape{}, std::nullopt};
  return expr::compile(gain.value, scope);
}

std::vector<std::pair<std::string, expr::Shape>> gain_shapes(const Instance& instance) {
  const expr::Scope scope = instance.design_scope();
  std::vector<std::pair<std::string, expr::Shape>> shapes;
  for (const Gain& gain : instance.method->gains)
    shapes.emplace_back(gain.name, compile_gain(gain, scope).shape());
  return shapes;
}

double scalar_value(const expr::Expression& expression, const expr::Scope& scope,
                    const numbers::Values& values) {
  return numbers::evaluate(expr::compile(expression, scope, expr::Shape{}), values)(0, 0);
}

expr::Program compile_value(const Value& value, const expr::Scope& scope,
                            std::optional<expr::Shape> expected) {
  return expr::compile(oriented(value, expected && is_proper_column(*expected)), scope, expected);
}

numbers::Matrix matrix_value(const Value& value, const expr::Scope& scope, const numbers::Values& values,
                          std::optional<expr::Shape> expected) {
  return numbers::evaluate(compile_value(value, scope, expected), values);
}

}  // namespace gainsmith::model
