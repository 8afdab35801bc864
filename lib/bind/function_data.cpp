#include "bind/function_data.h"

#include <algorithm>

#include "base/named.h"
#include "bind/formulas.h"
#include "expr/binding/functions.h"

namespace gainsmith::bind {

namespace {

/// "f(x, u)".
std::string called(const model::Declaration& datum) {
  std::string text;
  for (const model::Argument& argument : datum.arguments)
    text += (text.empty() ? "" : ", ") + argument.name;
  return datum.name + "(" + text + ")";
}

/// "f(x) (n; x: n)".
std::string declared(const model::Declaration& datum) {
  std::string shapes = datum.shape.text;
  for (const model::Argument& argument : datum.arguments)
    shapes += "; " + argument.name + ": " + argument.shape.text;
  return called(datum) + " (" + shapes + ")";
}

/// nullptr: the problem gives no function of this name.
const model::Let* given(const model::Problem& problem, const std::string& name) {
  const auto found =
      std::find_if(problem.functions.begin(), problem.functions.end(),
                   [&](const model::Let& let) { return let.signature.name == name; });
  return found == problem.functions.end() ? nullptr : &*found;
}

/// The function as the problem gives it, or as it is by default.
/// Arguments may be left out from the last on, where the text does not read them.
expr::Definition definition(const Binding& binding, const model::Declaration& datum) {
  if (const model::Let* let = given(binding.problem(), datum.name)) {
    const std::size_t expected = datum.arguments.size();
    const std::size_t found = let->signature.parameters.size();
    if (found > expected)
      throw InputError(let->place, datum.name + " has " + std::to_string(expected) +
                                       (expected == 1 ? " argument: " : " arguments: ") +
                                       declared(datum) + "; found " + std::to_string(found));
    expr::Definition function{let->signature.parameters, let->body};
    // Of those that are left out no text can have the name.
    for (std::size_t k = found; k < expected; ++k)
      function.parameters.push_back("#" + std::to_string(k));
    return function;
  }
  if (!datum.fallback)
    throw InputError({binding.problem().file},
                     "the datum " + declared(datum) + " of the method " + binding.method().name +
                         " is missing under 'data'; it is a function: " + called(datum) + ": ...");
  expr::Definition otherwise{{}, *datum.fallback};
  for (const model::Argument& argument : datum.arguments)
    otherwise.parameters.push_back(argument.name);
  return otherwise;
}

/// The names that a function may use: data before it, definitions of the problem, its arguments.
expr::Scope inside(const Binding& binding, const model::Declaration& datum,
                   const std::vector<std::string>& parameters) {
  expr::Scope scope = binding.names->known;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const model::Argument& argument = datum.arguments[k];
    const auto shape = resolve(argument.shape, binding.design->dimensions);
    if (!shape)
      throw InputError(argument.place, "the size of " + argument.name + " (" + argument.shape.text +
                                           ") does not follow from the data before " + datum.name);
    scope.definitions.erase(parameters[k]);
    scope.symbols[parameters[k]] = {*shape};
  }
  return scope;
}

}  // namespace

bool is_function(const model::Problem& problem, const model::Declaration& datum) {
  const bool function = !datum.arguments.empty();
  if (const model::Let* let = given(problem, datum.name); let != nullptr && !function)
    throw InputError(let->place, "the datum " + datum.name + " is declared " + datum.shape.text +
                                     "; found a function");
  const model::Value* matrix = find_named(problem.data, datum.name);
  if (function && matrix != nullptr)
    throw InputError(matrix->place, "the datum " + declared(datum) + " is a function: write " +
                                        called(datum) + ": ...");
  return function;
}

/// The text is compiled once, for its shape and its faults; it is bound anew where it is called.
void add_function(Binding& binding, const model::Declaration& datum) {
  expr::Definition function = definition(binding, datum);
  model::Dimensions& dimensions = binding.design->dimensions;
  const expr::Scope scope = inside(binding, datum, function.parameters);
  const auto expected = resolve(datum.shape, dimensions);
  const expr::Shape shape = expr::compile(function.body, scope, expected).shape();
  if (!learn(datum.shape, shape, dimensions))
    throw InputError(function.body.place(*function.body.root),
                     "the values of " + declared(datum) + " are " +
                         (expected ? to_string(*expected) : datum.shape.text) + "; found " +
                         to_string(shape));
  for (const std::string& parameter : function.parameters)
    function.shapes.push_back(scope.symbols.at(parameter).shape);
  binding.names->known.definitions[datum.name] = std::move(function);
  binding.names->known.dimensions = dimensions;
}

}  // namespace gainsmith::bind
