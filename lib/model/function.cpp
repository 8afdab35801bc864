#include "model/function.h"

#include <stdexcept>

namespace gainsmith::model {

namespace {

/// s^k; without instructions for k = 0.
expr::Program power(const std::string& variable, int k, const Place& place) {
  if (k == 0) return {};
  expr::Composer compose(place);
  const int s = compose.input(variable);
  return compose.take(k == 1 ? s : compose.apply(expr::Op::power, {s}, {}, {k}));
}

std::string power_text(const std::string& variable, int k) {
  if (k == 0) return "";
  return k == 1 ? variable : variable + "^" + std::to_string(k);
}

}  // namespace

Basis monomials(const std::string& variable, int degree, const Place& place) {
  Basis basis;
  for (int k = 0; k <= degree; ++k) {
    basis.elements.push_back(power(variable, k, place));
    basis.texts.push_back(power_text(variable, k));
  }
  return basis;
}

std::string coefficient_name(const std::string& name, std::size_t k) {
  return name + "_" + std::to_string(k);
}

std::string polynomial_text(const std::string& name, const std::string& variable, int degree) {
  return Function{name, variable, {}, {}, monomials(variable, degree, {}), {}}.text();
}

std::vector<std::string> Function::coefficients() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < size(); ++k) names.push_back(coefficient_name(name, k));
  return names;
}

std::string Function::text() const {
  std::string sum;
  for (std::size_t k = 0; k < size(); ++k) {
    const std::string coefficient = coefficient_name(name, k);
    const std::string& factor = basis.texts[k];
    if (k > 0) sum += " + ";
    if (factor.empty()) {
      sum += coefficient;
    } else {
      sum += basis.kind == Basis::Kind::monomials ? coefficient + "*" + factor
                                                  : factor + "*" + coefficient;
    }
  }
  return sum;
}

expr::Body Function::body() const {
  return {variable, expr::combination(basis.elements, coefficients(), shape, place)};
}

Bodies::Bodies(const std::vector<Function>& functions) {
  for (const Function& function : functions) set(function.name, function.body());
}

expr::Program Bodies::link(const expr::Program& program) const {
  return expr::link(program,
                    [&](const std::string& name, const expr::Instruction&) -> const expr::Body& {
                      const auto found = bodies_.find(name);
                      if (found == bodies_.end())
                        throw std::logic_error("the function " + name + " has no body");
                      return found->second;
                    });
}

}  // namespace gainsmith::model
