#include "bind/polynomials.h"


#include "base/number.h"
#include "bind/formulas.h"
#include "polynomial/monomial.h"

namespace gainsmith::bind {

namespace {

/// The least degree, a number that is written.
int least_degree(const Binding& binding, const model::UnknownDeclaration& unknown, int most) {
  if (!unknown.least) return 0;
  const model::Formula formula = scalar(*unknown.least, binding.names->known);
  const bool is_written = formula.program.inputs.empty();
  const double least = is_written ? scalar_value(formula, {}) : -1;
  if (!(least >= 0 && least <= most) || std::trunc(least) != least)
    throw InputError(formula.place, "the least degree of " + unknown.name +
                                        " must be written as a whole number from 0 to " +
                                        std::to_string(most));
  return static_cast<int>(least);
}

/// x(1), x(2), ..., or x of one element, of all arguments.
/// Arguments are columns with a length that is known from data.
std::vector<std::string> variables_of(const Binding& binding,
                                      const model::UnknownDeclaration& unknown) {
  std::vector<std::string> names;
  for (const model::Argument& argument : unknown.arguments) {
    const auto shape = resolve(argument.shape, binding.design->dimensions);
    if (!shape || shape->cols != 1 || shape->rows < 1)
      throw InputError(argument.place, "'" + argument.name + "' of " + unknown.name +
                                           ": expected the length of a column that the data have, "
                                           "such as n or 3, not " +
                                           argument.shape.text);
    for (int k = 1; k <= shape->rows; ++k)
      names.push_back(shape->rows == 1 ? argument.name
                                       : argument.name + "(" + std::to_string(k) + ")");
  }
  return names;
}

/// "V_2_0_0": the exponents in the order of the variables.
std::string coefficient_name(const std::string& name, const polynomial::Monomial& monomial,
                             std::size_t variables) {
  std::string result = name;
  for (std::size_t i = 0; i < variables; ++i) result += "_" + std::to_string(monomial.exponent(i));
  return result;
}

}  // namespace

/// The definition is a text, a sum of coefficients times monomials, so that it is bound like any
/// other.
void add_polynomial(Binding& binding, const model::UnknownDeclaration& unknown,
                    const model::Design::Unknown& like) {
  constexpr std::size_t kMostTerms = 5000;
  const std::vector<std::string> variables = variables_of(binding, unknown);
  const double count = polynomial::count_of_monomials(variables.size(), like.degree);
  if (count > kMostTerms)
    throw InputError(unknown.place, unknown.name + " has " + brief(count) +
                                        " terms; at most 5000 are computed with");
  expr::Scope& scope = binding.names->design;
  std::string text;
  const int least = least_degree(binding, unknown, like.degree);
  for (const polynomial::Monomial& monomial :
       polynomial::monomials(variables.size(), least, like.degree)) {
    model::Design::Unknown coefficient = like;
    coefficient.name = coefficient_name(unknown.name, monomial, variables.size());
    if (scope.symbols.contains(coefficient.name) || scope.definitions.contains(coefficient.name))
      throw InputError(unknown.place, "'" + coefficient.name + "', a coefficient of " +
                                          unknown.name + ", already has a meaning");
    scope.symbols[coefficient.name] = {coefficient.shape};
    text += (text.empty() ? "" : " + ") + coefficient.name;
    if (monomial.degree() > 0) text += "*" + to_string(monomial, variables);
    binding.design->unknowns.push_back(std::move(coefficient));
  }
  expr::Definition definition{{}, expr::parse(expr::Text::generated(text, unknown.place))};
  std::string signature = unknown.name + "(";
  for (const model::Argument& argument : unknown.arguments) {
    signature += (definition.parameters.empty() ? "" : ", ") + argument.name;
    definition.parameters.push_back(argument.name);
    definition.shapes.push_back(*resolve(argument.shape, binding.design->dimensions));
  }
  binding.design->polynomials.push_back({signature + ")", text});
  scope.definitions[unknown.name] = std::move(definition);
}

}  // namespace gainsmith::bind
