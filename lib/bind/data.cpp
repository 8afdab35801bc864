#include "bind/data.h"
#include "base/named.h"
#include "bind/polynomials.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/number.h"
#include "bind/data_names.h"
#include "bind/estimates.h"
#include "bind/families.h"
#include "bind/formulas.h"
#include "bind/function_data.h"
#include "expr/binding/functions.h"
#include "model/words.h"

namespace gainsmith::bind {

namespace {

/// The declaration with the sizes that are known, "n x p (n = 3)", for messages.
std::string declared(const model::Declaration& declaration, const model::Dimensions& dimensions) {
  std::string text = declaration.shape.text;
  // "n*n" is one size.
  if (declaration.shape.is_column() && text.find('*') != std::string::npos) text += " x 1";
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

/// Where each element is, row by row, when the matrix is written element by element.
std::vector<Place> element_places(const model::Value& value, expr::Shape shape) {
  const expr::Node& root = *value.value.root;
  std::vector<Place> places;
  if (root.kind != expr::NodeKind::block || root.columns != shape.cols ||
      std::ssize(root.children) != shape.size())
    return places;
  for (const expr::NodePtr& element : root.children) places.push_back(value.value.place(*element));
  return places;
}

/// A datum that is declared, with what the problem gives.
struct Given {
  model::Declaration declaration;
  std::optional<model::Value> value;
};

/// The datum itself, or the members of a family, each with its element of the list.
/// A family without a list gets one text, with the numbers of each member in it.
std::vector<Given> given(Binding& binding, const model::Declaration& datum) {
  const model::Value* found = find_named(binding.problem().data, datum.name);
  const auto value = found ? std::optional(*found) : std::nullopt;
  if (datum.indices.empty()) {
    if (value && !value->matrices.empty())
      throw InputError(value->place, "the datum " + datum.name + " is declared " +
                                         datum.shape.text + "; found a list of matrices");
    return {{datum, value}};
  }
  if (!value && !datum.fallback)
    throw InputError({binding.problem().file}, "the datum " + datum.name + " (" + datum.shape.text +
                                                   " for each index) of the "
                                                   "method " +
                                                   binding.method().name +
                                                   " is missing under 'data'" + kFamilyTakes);
  const std::vector<model::Value> elements =
      value ? elements_of(*value) : std::vector<model::Value>{};
  for (const model::Value& element : elements)
    if (!element.matrices.empty())
      throw InputError(element.place, "the family " + datum.name +
                                          " takes a list of matrices; this member is one itself: "
                                          "a bracket too many");
  if (!elements.empty()) learn_count(datum.indices, elements.size(), binding.design->dimensions);
  expr::Scope& scope = binding.names->known;
  scope.dimensions = binding.design->dimensions;
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

/// The range in which the problem searches for a scalar.
/// nullptr: it is not searched.
const model::ScalarRange* find_searched(const Binding& binding, const std::string& name) {
  if (!binding.problem().search) return nullptr;
  const model::Search& search = *binding.problem().search;
  if (search.extreme && search.extreme->name == name) return &*search.extreme;
  return find_named(search.over, name);
}

/// A scalar without a value gets the value at which the search for it begins.
void start_at_end(const Binding& binding, const model::ScalarRange& searched,
                  model::Design::Datum& datum) {
  datum.range = range(searched, binding.names->known);
  const auto& search = binding.problem().search;
  const bool smallest =
      search && !search->largest && search->extreme && search->extreme->name == searched.name;
  datum.value = smallest ? datum.range->high : datum.range->low;
  datum.place = searched.place;
}

/// Evaluates a datum, gives it its name, and adds it to the list.
void define(Binding& binding, model::Design::Datum datum, std::vector<model::Design::Datum>& list) {
  numbers::Matrix matrix =
      value_of(*binding.design, datum, binding.overrides, binding.recorder->values);
  binding.names->known.symbols[datum.name] = {datum.shape, true};
  binding.names->known.dimensions = binding.design->dimensions;
  binding.recorder->values[datum.name] = std::move(matrix);
  if (datum.value) note_estimate(*binding.design, datum.name, datum.value->program);
  list.push_back(std::move(datum));
}

/// How a column or a row is written, where its transpose was given: what does not fit would.
std::string transpose_hint(const model::ShapeText& declared, expr::Shape shape,
                           model::Dimensions known) {
  if ((shape.rows == 1) == (shape.cols == 1)) return "";
  const auto expected = resolve(declared, known);
  const bool fits = expected ? (expected->rows == shape.rows || expected->rows == shape.cols) &&
                                   (expected->cols == shape.cols || expected->cols == shape.rows)
                             : learn(declared, {shape.cols, shape.rows}, known);
  if (!fits) return "";
  return shape.rows == 1 ? "; a column is written [[1], [2]], or \"[1; 2]\" as a formula"
                         : "; a row is written [1, 2]";
}

/// Whether only a column of the elements of a flat list fits, as far as sizes are known.
bool fits_as_column(const model::Declaration& datum, const model::Value& value,
                    model::Dimensions known) {
  const auto size = static_cast<int>(value.value.root->children.size());
  model::Dimensions of_row = known;
  return value.flat && !learn(datum.shape, {1, size}, of_row) &&
         learn(datum.shape, {size, 1}, known);
}

/// "2 x 3", of a file "2 x 3 in A.csv".
std::string found_text(const model::Value& value, expr::Shape shape) {
  return to_string(shape) + (value.source.empty() ? "" : " in " + value.source);
}

/// The value is compiled over what is known so far. A flat list is turned where a column is
/// declared. Then its shape teaches dimensions.
void add_datum(Binding& binding, const Given& given) {
  const model::Declaration& datum = given.declaration;
  model::Dimensions& dimensions = binding.design->dimensions;
  model::Design::Datum bound;
  bound.name = datum.name;
  bound.structure = datum.shape.structure;
  bound.declared = datum.shape.text;
  bound.missing = "the datum " + datum.name + " (" + datum.shape.text + ") of the method " +
                  binding.method().name + " is missing under 'data'";
  const model::ScalarRange* searched = find_searched(binding, datum.name);
  if (!given.value && !datum.fallback && searched != nullptr) {
    start_at_end(binding, *searched, bound);
    return define(binding, std::move(bound), binding.design->data);
  }
  if (!given.value && !datum.fallback)
    return define(binding, std::move(bound), binding.design->data);
  const model::Value value =
      given.value ? *given.value : model::Value{datum.name, *datum.fallback, false, datum.place};
  refuse_later_data(binding, value);
  const auto expected = resolve(datum.shape, dimensions);
  const bool column = datum.shape.is_column() || (expected && is_proper_column(*expected)) ||
                      fits_as_column(datum, value, dimensions);
  model::Value turned{value.name, oriented(value, column), false, value.place};
  bound.place = value.place;
  bound.value =
      formula(turned.value, binding.names->known, has_free_size(value) ? expected : std::nullopt);
  const expr::Node& root = *value.value.root;
  const bool is_gain = root.kind == expr::NodeKind::call &&
                       (root.text == "output_gain" || root.text == "discrete_output_gain");
  bound.chosen = is_gain || model::chooses_basis(bound.value->program);
  binding.data_texts.insert_or_assign(datum.name, turned.value);
  bound.shape = bound.value->program.shape();
  if (!learn(datum.shape, bound.shape, dimensions))
    throw InputError(value.place, "the datum " + datum.name + " is declared " +
                                      declared(datum, dimensions) + "; found " +
                                      found_text(value, bound.shape) +
                                      (datum.indices.empty() ? "" : kFamilyTakes) +
                                      transpose_hint(datum.shape, bound.shape, dimensions));
  bound.elements = element_places(value, bound.shape);
  define(binding, std::move(bound), binding.design->data);
}

/// A datum that is a system is a definition, whose matrices texts read, with its sizes.
void add_system(Binding& binding, const model::Declaration& datum) {
  const model::Value* value = find_named(binding.problem().data, datum.name);
  if (value == nullptr && !datum.fallback)
    throw InputError({binding.problem().file},
                     "the datum " + datum.name + " (" + datum.shape.text + ") of the method " +
                         binding.method().name +
                         " is missing under 'data', such as tf(1, [1, 2]) or ss(A, B, C, D)");
  const expr::Expression text = value != nullptr ? value->value : *datum.fallback;
  const Place place = value != nullptr ? value->place : datum.place;
  if (value != nullptr) refuse_later_data(binding, *value);
  const expr::CompiledSystem system = expr::compile_system(text, binding.names->known);
  const expr::Shape whole = system.matrix.shape();
  if (!learn_system(datum.shape, whole, system.states, binding.design->dimensions))
    throw InputError(place, "the datum " + datum.name + " is declared " +
                                declared(datum, binding.design->dimensions) + "; found " +
                                std::to_string(system.states) + " states, " +
                                std::to_string(whole.rows - system.states) + " outputs and " +
                                std::to_string(whole.cols - system.states) + " inputs");
  binding.names->known.definitions[datum.name] = {{}, text};
  binding.names->known.dimensions = binding.design->dimensions;
}

/// A size such as n + p may have been unknown when the datum was read.
void check_shape(const Binding& binding, const Given& given) {
  const model::Declaration& datum = given.declaration;
  const expr::Shape shape = binding.names->known.symbols.at(datum.name).shape;
  // Without rows, or without columns, a matrix says that there is no output, no input. A plant
  // without states is a mistake.
  const bool empty = shape.rows == 0 && shape.cols == 0 && given.value;
  if (learn(datum.shape, shape, binding.design->dimensions) && !empty) return;
  throw InputError(given.value ? given.value->place : datum.place,
                   "the datum " + datum.name + " is declared " +
                       declared(datum, binding.design->dimensions) + "; found " +
                       (given.value ? found_text(*given.value, shape) : to_string(shape)));
}

/// The text of a parameter: the problem's, or the method's default.
/// nullptr where neither gives one.
const expr::Expression* text_of(const Binding& binding, const model::Parameter& parameter) {
  if (const model::Value* given = find_named(binding.problem().parameters, parameter.name))
    return &given->value;
  return parameter.fallback ? &*parameter.fallback : nullptr;
}

/// Whether it is a number, which data may read.
bool comes_first(const Binding& binding, const model::Parameter& parameter) {
  const expr::Expression* text = text_of(binding, parameter);
  return text != nullptr && names_in(*text).empty();
}

/// A parameter has a value, a default, or a range in which it is searched.
void add_parameter(Binding& binding, const model::Parameter& parameter) {
  model::Design::Datum bound;
  bound.first = comes_first(binding, parameter);
  bound.name = parameter.name;
  bound.structure = model::Structure::scalar;
  bound.declared = "scalar";
  bound.missing = "the parameter " + parameter.name + " of the method " + binding.method().name +
                  " has no default and is missing under 'parameters'";
  const model::Value* given = find_named(binding.problem().parameters, parameter.name);
  const model::ScalarRange* searched = find_searched(binding, parameter.name);
  if (searched == nullptr && parameter.search) searched = &*parameter.search;
  if (const expr::Expression* text = text_of(binding, parameter)) {
    bound.value = scalar(*text, binding.names->known);
    binding.data_texts.insert_or_assign(parameter.name, *text);
    bound.place = given ? given->place : parameter.place;
  } else if (searched != nullptr) {
    start_at_end(binding, *searched, bound);
  }
  define(binding, std::move(bound), binding.design->parameters);
}

/// nullptr: the method has no definition of this name.
const model::Let* find_let(const model::Method& method, const std::string& name) {
  const auto found = std::ranges::find_if(
      method.let, [&](const model::Let& let) { return let.signature.name == name; });
  return found == method.let.end() ? nullptr : &*found;
}

/// What a name that a problem defines is already; empty: nothing.
std::string meaning_of(const Binding& binding, const std::string& name) {
  const model::Method& method = binding.method();
  const std::string of_method = " of the method " + method.name;
  if (has_named(method.data, name))
    return "it is a datum of the method, whose place is under 'data'";
  if (has_named(method.parameters, name))
    return "it is a parameter of the method, whose place is under 'parameters'";
  if (has_named(method.unknowns, name)) return "it is an unknown" + of_method;
  if (has_named(method.gains, name)) return "it is a gain" + of_method;
  // Those of a method in the problem itself may be set again: `--set k=2`.
  if (model::is_method_file(method.file) && find_let(method, name) != nullptr)
    return "it is a definition" + of_method;
  if (expr::is_reserved(name)) return "it is a word of the language";
  if (binding.names->known.symbols.contains(name)) return "it is a name of the problem";
  return "";
}

/// The definitions of the problem, which its data may use, too.
void add_problem_definitions(Binding& binding) {
  for (const model::Let& let : binding.problem().let) {
    const std::string& name = let.signature.name;
    if (const std::string meaning = meaning_of(binding, name); !meaning.empty())
      throw InputError(let.place, "'" + name + "' already has a meaning: " + meaning);
    binding.names->known.definitions[name] = {let.signature.parameters, let.body};
  }
}

/// Definitions are texts, bound wherever they are used.
void add_definitions(Binding& binding) {
  auto& definitions = binding.names->known.definitions;
  for (const model::Let& let : binding.method().let)
    definitions[let.signature.name] = {let.signature.parameters, let.body};
  add_problem_definitions(binding);
  if (binding.method().has_dynamics) return;  // signals come with the dynamics
  for (const model::Named& signal : binding.method().signals)
    definitions[signal.name] = {{}, signal.value};
}

/// Each conjunct of it is a chain of comparisons of numbers. The place of its fault is that of a
/// scalar in it which the problem gives.
void add_assumption(Binding& binding, const model::Named& assumption) {
  model::Design::Assumption bound;
  bound.name = assumption.name;
  bound.text = assumption.value.text->str();
  for (const expr::Expression& part : conjuncts(assumption.value))
    for (const auto& relation : compile_relations(part, binding.names->known)) {
      if (relation.equation)
        throw InputError(assumption.place,
                         "'==' is for requirements only; an assumption is an "
                         "inequality of scalars, such as 0 < T1 <= T2");
      refuse_estimate(*binding.design, relation.difference, "an assumption");
      bound.differences.emplace_back(relation.difference, relation.strict);
    }
  for (const std::string& name : names_in(assumption.value)) {
    const auto value = binding.recorder->values.find(name);
    if (value == binding.recorder->values.end() || value->second.size() != 1) continue;
    bound.scalars.push_back(name);
    for (const auto* list : {&binding.problem().data, &binding.problem().parameters})
      if (const model::Value* given = find_named(*list, name)) bound.place = given->place;
  }
  if (bound.place.file.empty()) bound.place = assumption.place;
  check_assumption(*binding.design, bound, binding.recorder->values);
  binding.design->assumptions.push_back(std::move(bound));
}

/// The degree of an unknown function, a whole number from 0 to 30; 0 of a matrix.
int degree_of(const Binding& binding, const model::UnknownDeclaration& unknown,
              model::Design::Unknown& bound) {
  constexpr int kLargest = 30;
  if (!unknown.degree) return 0;
  bound.degree_formula = scalar(*unknown.degree, binding.names->known);
  const double degree = scalar_value(*bound.degree_formula, binding.recorder->values);
  if (!(degree >= 0 && degree <= kLargest) || std::trunc(degree) != degree)
    throw InputError(bound.degree_formula->place,
                     "the degree of " + unknown.name + " must be a whole number from 0 to " +
                         std::to_string(kLargest) + ", not " + brief(degree));
  return static_cast<int>(degree);
}

/// The shape of a declaration. InputError where a size of it does not follow from data.
expr::Shape known_shape(const Binding& binding, const model::Declaration& declaration,
                        const char* what) {
  if (const auto shape = resolve(declaration.shape, binding.design->dimensions)) return *shape;
  throw InputError(declaration.place,
                   "the size of the " + std::string(what) + " " + declaration.name + " (" +
                       declaration.shape.text +
                       ") does not follow from the data; a shape is n x p, n, scalar, symmetric n "
                       "or diagonal n, with sizes that the data have");
}

/// A matrix, or a function sum_k X_k b_k(s) of a number with coefficients X_0, ..., X_degree; or a
/// polynomial in columns (polynomials.h).
void add_unknown(Binding& binding, const model::UnknownDeclaration& unknown) {
  expr::Scope& scope = binding.names->design;
  model::Design::Unknown bound;
  bound.name = unknown.name;
  bound.shape = known_shape(binding, unknown, "unknown");
  bound.structure = unknown.shape.structure;
  bound.variable = unknown.variable;
  bound.declared = unknown.shape.text;
  bound.place = unknown.place;
  bound.degree = degree_of(binding, unknown, bound);
  if (!unknown.arguments.empty()) return add_polynomial(binding, unknown, bound);
  if (unknown.in) {
    bound.in = {unknown.name, scalar(unknown.in->low, binding.names->known),
                scalar(unknown.in->high, binding.names->known), unknown.in->place};
    ends_of(*bound.in, binding.recorder->values);
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
  binding.design->unknowns.push_back(std::move(bound));
}

/// Each member of a family is an unknown of its own, "P_2".
void add_unknowns(Binding& binding) {
  binding.names->design = binding.names->known;
  expr::Scope& scope = binding.names->design;
  for (const model::UnknownDeclaration& unknown : binding.method().unknowns) {
    if (unknown.indices.empty()) {
      add_unknown(binding, unknown);
      continue;
    }
    scope.families[unknown.name] = ranges(unknown.indices, scope);
    for (const Member& member : members(unknown.indices, {}, scope)) {
      model::UnknownDeclaration of_member = unknown;
      of_member.name = member.name_of(unknown.name);
      if (of_member.degree) of_member.degree = instantiate(*of_member.degree, member, scope);
      if (of_member.in)
        for (expr::Expression* end : {&of_member.in->low, &of_member.in->high})
          *end = instantiate(*end, member, scope);
      add_unknown(binding, of_member);
    }
  }
}

}  // namespace

/// Parameters that are plain numbers come first, so that data may read them; the others follow the
/// data.
void bind_data(Binding& binding) {
  refuse_unknown_names(binding);
  for (const auto& [name, value] : binding.overrides) {
    check_scalar_name(binding.method(), name, {binding.problem().file});
    if (!std::isfinite(value))
      throw InputError({binding.problem().file}, name + ": expected a finite number");
  }
  for (const model::Parameter& parameter : binding.method().parameters)
    if (comes_first(binding, parameter)) add_parameter(binding, parameter);
  add_problem_definitions(binding);
  std::vector<Given> all;
  for (const model::Declaration& datum : binding.method().data) {
    if (is_function(binding.problem(), datum)) {
      add_function(binding, datum);
      continue;
    }
    if (datum.shape.system) {
      add_system(binding, datum);
      continue;
    }
    for (Given& member : given(binding, datum)) {
      add_datum(binding, member);
      all.push_back(std::move(member));
    }
  }
  for (const Given& datum : all) check_shape(binding, datum);
  for (const model::Parameter& parameter : binding.method().parameters)
    if (!comes_first(binding, parameter)) add_parameter(binding, parameter);
  std::ranges::sort(binding.design->parameters, {}, [&](const model::Design::Datum& datum) {
    return find_named(binding.method().parameters, datum.name);
  });
  for (const auto& [name, value] : binding.overrides)
    check_scalar_name(*binding.design, name, {binding.problem().file});
  add_definitions(binding);
  for (const model::Named& assumption : binding.method().assume)
    add_assumption(binding, assumption);
  add_unknowns(binding);
}

}  // namespace gainsmith::bind
