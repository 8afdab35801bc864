#include "model/unknown_function.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "expr/compile.h"
#include "expr/parser.h"
#include "model/instance.h"

namespace gainsmith::model {

namespace {

/// The text in the variable and the coefficients alone, and of the function's shape.
void check_text(const UnknownFunction& function, const expr::Expression& body, const Place& place) {
  expr::Scope scope;
  scope.symbols[function.variable] = {expr::Shape{}, std::nullopt};
  for (const std::string& coefficient : function.coefficients)
    scope.symbols[coefficient] = {function.shape, std::nullopt};
  const expr::Shape found = expr::compile(body, scope).shape();
  if (found != function.shape)
    throw InputError(place, function.signature() + " is " + to_string(function.shape) + ", but '" +
                                function.text + "' is " + to_string(found));
}

void define(Instance& instance, const UnknownFunction& function, const Place& place) {
  const expr::Expression body = expr::parse(expr::Text::generated(function.text, place));
  check_text(function, body, place);
  instance.scope.definitions[function.name] = {{function.variable}, body};
}

std::vector<std::string> coefficient_names(const std::string& name, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) names.push_back(coefficient_name(name, k));
  return names;
}

std::vector<UnknownMatrix> matrices_of(const UnknownFunction& function) {
  std::vector<UnknownMatrix> matrices;
  for (const std::string& coefficient : function.coefficients)
    matrices.push_back({coefficient, function.shape, function.structure});
  return matrices;
}

}  // namespace

std::string coefficient_name(const std::string& name, std::size_t k) {
  return name + "_" + std::to_string(k);
}

std::string polynomial_text(const std::string& name, const std::string& variable, int degree) {
  std::string text = coefficient_name(name, 0);
  for (int k = 1; k <= degree; ++k) {
    text += " + " + coefficient_name(name, static_cast<std::size_t>(k)) + "*" + variable;
    if (k > 1) text += "^" + std::to_string(k);
  }
  return text;
}

bool is_polynomial(const UnknownFunction& function) {
  const int degree = static_cast<int>(function.coefficients.size()) - 1;
  return function.text == polynomial_text(function.name, function.variable, degree);
}

void add_polynomial(Instance& instance, UnknownFunction function, int degree) {
  function.coefficients = coefficient_names(function.name, static_cast<std::size_t>(degree) + 1);
  function.text = polynomial_text(function.name, function.variable, degree);
  define(instance, function, function.place);
  for (UnknownMatrix& matrix : matrices_of(function))
    instance.unknowns.push_back(std::move(matrix));
  instance.functions.push_back(std::move(function));
}

void redefine(Instance& instance, const std::string& name, std::size_t count,
              const std::string& text, const Place& place) {
  const auto function =
      std::find_if(instance.functions.begin(), instance.functions.end(),
                   [&](const UnknownFunction& candidate) { return candidate.name == name; });
  if (function == instance.functions.end())
    throw std::logic_error("there is no unknown function " + name);
  const std::vector<std::string> old =
      std::exchange(function->coefficients, coefficient_names(name, count));
  function->text = text;
  define(instance, *function, place);

  const auto is_old = [&](const UnknownMatrix& unknown) {
    return std::find(old.begin(), old.end(), unknown.name) != old.end();
  };
  auto& unknowns = instance.unknowns;
  const auto first = std::find_if(unknowns.begin(), unknowns.end(), is_old);
  const auto at = first - unknowns.begin();
  unknowns.erase(std::remove_if(first, unknowns.end(), is_old), unknowns.end());
  const std::vector<UnknownMatrix> fresh = matrices_of(*function);
  unknowns.insert(unknowns.begin() + at, fresh.begin(), fresh.end());
}

}  // namespace gainsmith::model
