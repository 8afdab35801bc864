// Dimensions, data, parameters, assumptions, unknowns and states.
#include <algorithm>
#include <cmath>

#include "base/nearest.h"
#include "base/number.h"
#include "bind/binding.h"
#include "expr/functions.h"

namespace gainsmith::bind {

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

std::string declared(const model::Declaration& declaration, const model::Dimensions& dimensions) {
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

constexpr const char* kFamilyTakes =
    "; a family takes a list with a matrix for each member, or one expression for all";

/// Whether the expression may take its size from its place: a bare number or a multiple of I.
bool has_free_size(const model::Value& value) {
  const auto names = names_in(value.value);
  return names.contains("I") || value.value.root->kind == expr::NodeKind::number;
}

/// Where each element stands, row by row, when the matrix is written element by element.
std::vector<Place> element_places(const model::Value& value, expr::Shape shape) {
  const expr::Node& root = *value.value.root;
  std::vector<Place> places;
  if (root.kind != expr::NodeKind::block || root.columns != shape.cols ||
      std::ssize(root.children) != shape.size())
    return places;
  for (const expr::NodePtr& element : root.children) places.push_back(value.value.place(*element));
  return places;
}

}  // namespace

void Binding::bind_data() {
  refuse_unknown_names();
  for (const auto& [name, value] : overrides_) {
    check_scalar_name(method(), name, {problem().file});
    if (!std::isfinite(value))
      throw InputError({problem().file}, name + ": expected a finite number");
  }
  std::vector<Given> all;
  for (const model::Declaration& datum : method().data)
    for (Given& member : given(datum)) {
      add_datum(member);
      all.push_back(std::move(member));
    }
  for (const Given& datum : all) check_shape(datum);
  for (const model::Parameter& parameter : method().parameters) add_parameter(parameter);
  for (const auto& [name, value] : overrides_) check_scalar_name(*design_, name, {problem().file});
  add_definitions();
  for (const model::Named& assumption : method().assume) add_assumption(assumption);
  add_unknowns();
}

void Binding::refuse_unknown_names() const {
  const auto data = names_of(method().data);
  const auto parameters = names_of(method().parameters);
  const auto refuse =
      [&](const std::vector<model::Value>& values, const std::vector<std::string>& known,
          const std::vector<std::string>& elsewhere, const char* what, const char* other) {
        for (const model::Value& value : values) {
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

/// The range in which the problem looks for a scalar.
const model::ScalarRange* Binding::find_searched(const std::string& name) const {
  if (!problem().search) return nullptr;
  const model::Search& search = *problem().search;
  if (search.extreme && search.extreme->name == name) return &*search.extreme;
  return find_named(search.over, name);
}

/// A scalar without a value stands where the search for it begins.
void Binding::start_at_end(const model::ScalarRange& searched, model::Design::Datum& datum) const {
  datum.range = range(searched);
  const auto& search = problem().search;
  const bool smallest =
      search && !search->largest && search->extreme && search->extreme->name == searched.name;
  datum.value = smallest ? datum.range->high : datum.range->low;
  datum.place = searched.place;
}

void Binding::define(model::Design::Datum datum, std::vector<model::Design::Datum>& list) {
  numbers::Matrix matrix = value_of(*design_, datum, overrides_, recorder_->values);
  names_->known.symbols[datum.name] = {datum.shape, true};
  names_->known.dimensions = design_->dimensions;
  recorder_->values[datum.name] = std::move(matrix);
  if (datum.value) note_estimate(datum.name, datum.value->program);
  list.push_back(std::move(datum));
}

expr::Expression Binding::instantiate(const expr::Expression& expression, const Member& member,
                                      const expr::Scope& scope) const {
  if (member.indices.empty()) return expression;
  return expr::instantiate(expression, member.indices, scope.families);
}

/// The datum itself, or the members of a family, each with its element of the list.
std::vector<Binding::Given> Binding::given(const model::Declaration& datum) {
  const model::Value* found = find_named(problem().data, datum.name);
  const auto value = found ? std::optional(*found) : std::nullopt;
  if (datum.indices.empty()) {
    if (value && !value->matrices.empty())
      throw InputError(value->place, "the datum " + datum.name + " is declared " +
                                         datum.shape.text + "; found a list of matrices");
    return {{datum, value}};
  }
  if (!value && !datum.fallback)
    throw InputError({problem().file}, "the datum " + datum.name + " (" + datum.shape.text +
                                           " for each index) of the "
                                           "method " +
                                           method().name + " is missing under 'data'" +
                                           kFamilyTakes);
  const std::vector<model::Value> elements =
      value ? elements_of(*value) : std::vector<model::Value>{};
  for (const model::Value& element : elements)
    if (!element.matrices.empty())
      throw InputError(element.place, "the family " + datum.name +
                                          " takes a list of matrices; this member is one itself: "
                                          "a bracket too many");
  if (!elements.empty()) learn_count(datum.indices, elements.size(), design_->dimensions);
  expr::Scope& scope = names_->known;
  scope.dimensions = design_->dimensions;
  scope.families[datum.name] = ranges(datum.indices, scope);
  const auto all = members(datum.indices, {}, scope);
  if (!elements.empty() && elements.size() != all.size())
    throw InputError(value->place, "the family " + datum.name + " has " +
                                       std::to_string(all.size()) +
                                       " members by the data before it; found " +
                                       std::to_string(elements.size()));
  std::vector<Given> result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Given member{datum, value};
    member.declaration.name = all[k].name_of(datum.name);
    if (!elements.empty()) member.value = elements[k];
    for (auto* text : {member.value && elements.empty() ? &member.value->value : nullptr,
                       datum.fallback ? &*member.declaration.fallback : nullptr})
      if (text != nullptr) *text = instantiate(*text, all[k], scope);
    result.push_back(std::move(member));
  }
  return result;
}

void Binding::add_datum(const Given& given) {
  const model::Declaration& datum = given.declaration;
  model::Dimensions& dimensions = design_->dimensions;
  model::Design::Datum bound;
  bound.name = datum.name;
  bound.structure = datum.shape.structure;
  bound.declared = datum.shape.text;
  bound.missing = "the datum " + datum.name + " (" + datum.shape.text + ") of the method " +
                  method().name + " is missing under 'data'";
  const model::ScalarRange* searched = find_searched(datum.name);
  if (!given.value && !datum.fallback && searched != nullptr) {
    start_at_end(*searched, bound);
    return define(std::move(bound), design_->data);
  }
  if (!given.value && !datum.fallback) return define(std::move(bound), design_->data);
  const model::Value value =
      given.value ? *given.value : model::Value{datum.name, *datum.fallback, false, datum.place};
  const auto expected = resolve(datum.shape, dimensions);
  const bool column = datum.shape.is_column() || (expected && is_proper_column(*expected));
  model::Value turned{value.name, oriented(value, column), false, value.place};
  bound.place = value.place;
  bound.value =
      formula(turned.value, names_->known, has_free_size(value) ? expected : std::nullopt);
  bound.shape = bound.value->program.shape();
  if (!learn(datum.shape, bound.shape, dimensions))
    throw InputError(value.place, "the datum " + datum.name + " is declared " +
                                      declared(datum, dimensions) + "; found " +
                                      to_string(bound.shape) +
                                      (datum.indices.empty() ? "" : kFamilyTakes));
  bound.elements = element_places(value, bound.shape);
  define(std::move(bound), design_->data);
}

/// A size such as n + p may have been unknown when the datum was read.
void Binding::check_shape(const Given& given) const {
  const model::Declaration& datum = given.declaration;
  const expr::Shape shape = names_->known.symbols.at(datum.name).shape;
  // Without rows, or without columns, a matrix says that there is no output, no input. A plant
  // without states is a mistake.
  const bool empty = shape.rows == 0 && shape.cols == 0 && given.value;
  if (learn(datum.shape, shape, design_->dimensions) && !empty) return;
  throw InputError(given.value ? given.value->place : datum.place,
                   "the datum " + datum.name + " is declared " +
                       declared(datum, design_->dimensions) + "; found " + to_string(shape));
}

void Binding::add_parameter(const model::Parameter& parameter) {
  model::Design::Datum bound;
  bound.name = parameter.name;
  bound.structure = model::Structure::scalar;
  bound.declared = "scalar";
  bound.missing = "the parameter " + parameter.name + " of the method " + method().name +
                  " has no default and is missing under 'parameters'";
  const model::Value* given = find_named(problem().parameters, parameter.name);
  const model::ScalarRange* searched = find_searched(parameter.name);
  if (searched == nullptr && parameter.search) searched = &*parameter.search;
  if (given != nullptr || parameter.fallback) {
    bound.value = scalar(given ? given->value : *parameter.fallback, names_->known);
    bound.place = given ? given->place : parameter.place;
  } else if (searched != nullptr) {
    start_at_end(*searched, bound);
  }
  define(std::move(bound), design_->parameters);
}

void Binding::add_definitions() {
  auto& definitions = names_->known.definitions;
  for (const model::Let& let : method().let)
    definitions[let.signature.name] = {let.signature.parameters, let.body};
  for (const model::Let& let : problem().let) {
    const std::string& name = let.signature.name;
    if (names_->known.symbols.contains(name) || expr::is_reserved(name))
      throw InputError(let.place, "'" + name + "' already has a meaning");
    definitions[name] = {let.signature.parameters, let.body};
  }
  if (method().has_dynamics) return;  // signals come with the dynamics
  for (const model::Named& signal : method().signals) definitions[signal.name] = {{}, signal.value};
}

void Binding::add_assumption(const model::Named& assumption) {
  model::Design::Assumption bound;
  bound.text = assumption.value.text->str();
  for (const auto& relation : compile_relations(assumption.value, names_->known)) {
    if (relation.equation)
      throw InputError(assumption.place,
                       "'==' stands in requirements only; an assumption is an "
                       "inequality of scalars, such as 0 < T1 <= T2");
    refuse_estimate(relation.difference, "an assumption");
    bound.differences.emplace_back(relation.difference, relation.strict);
  }
  for (const std::string& name : names_in(assumption.value)) {
    const auto value = recorder_->values.find(name);
    if (value == recorder_->values.end() || value->second.size() != 1) continue;
    bound.scalars.push_back(name);
    for (const auto* list : {&problem().data, &problem().parameters})
      if (const model::Value* given = find_named(*list, name)) bound.place = given->place;
  }
  check_assumption(*design_, bound, recorder_->values);
  design_->assumptions.push_back(std::move(bound));
}

int Binding::degree_of(const model::UnknownDeclaration& unknown,
                       model::Design::Unknown& bound) const {
  constexpr int kLargest = 30;
  if (!unknown.degree) return 0;
  bound.degree_formula = scalar(*unknown.degree, names_->known);
  const double degree = scalar_value(*bound.degree_formula, recorder_->values);
  if (!(degree >= 0 && degree <= kLargest) || std::trunc(degree) != degree)
    throw InputError(bound.degree_formula->place,
                     "the degree of " + unknown.name + " must be a whole number from 0 to " +
                         std::to_string(kLargest) + ", not " + brief(degree));
  return static_cast<int>(degree);
}

void Binding::add_unknowns() {
  names_->design = names_->known;
  expr::Scope& scope = names_->design;
  for (const model::UnknownDeclaration& unknown : method().unknowns) {
    if (unknown.indices.empty()) {
      add_unknown(unknown);
      continue;
    }
    scope.families[unknown.name] = ranges(unknown.indices, scope);
    for (const Member& member : members(unknown.indices, {}, scope)) {
      model::UnknownDeclaration one = unknown;
      one.name = member.name_of(unknown.name);
      if (one.degree) one.degree = instantiate(*one.degree, member, scope);
      if (one.in)
        for (expr::Expression* end : {&one.in->low, &one.in->high})
          *end = instantiate(*end, member, scope);
      add_unknown(one);
    }
  }
}

void Binding::add_unknown(const model::UnknownDeclaration& unknown) {
  expr::Scope& scope = names_->design;
  model::Design::Unknown bound;
  bound.name = unknown.name;
  bound.shape = known_shape(unknown, "unknown");
  bound.structure = unknown.shape.structure;
  bound.variable = unknown.variable;
  bound.declared = unknown.shape.text;
  bound.place = unknown.place;
  bound.degree = degree_of(unknown, bound);
  if (unknown.in) {
    bound.in = {unknown.name, scalar(unknown.in->low, names_->known),
                scalar(unknown.in->high, names_->known), unknown.in->place};
    ends_of(*bound.in, recorder_->values);
  }
  if (unknown.variable.empty()) {
    scope.symbols[unknown.name] = {bound.shape};
  } else {
    for (int k = 0; k <= bound.degree; ++k)
      scope.symbols[model::coefficient_name(unknown.name, static_cast<std::size_t>(k))] = {
          bound.shape};
    scope.functions[unknown.name] = bound.shape;
    scope.functions[expr::derivative_name(unknown.name)] = bound.shape;
  }
  design_->unknowns.push_back(std::move(bound));
}

expr::Shape Binding::known_shape(const model::Declaration& declaration, const char* what) const {
  if (const auto shape = resolve(declaration.shape, design_->dimensions)) return *shape;
  throw InputError(declaration.place,
                   "the size of the " + std::string(what) + " " + declaration.name + " (" +
                       declaration.shape.text +
                       ") does not follow from the data; a shape is n x p, n, scalar, symmetric n "
                       "or diagonal n, with sizes that the data have");
}

}  // namespace gainsmith::bind
