#include "model/function.h"

#include <stdexcept>

#include "expr/binding/chebyshev.h"
#include "expr/binding/scope.h"

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

/// k s^(k-1); without instructions for k = 1.
expr::Program power_derivative(const std::string& variable, int k, const Place& place) {
  if (k == 1) return {};
  expr::Composer compose(place);
  const int s = compose.input(variable);
  const int power = k == 2 ? s : compose.apply(expr::Op::power, {s}, {}, {k - 1});
  return compose.take(
      compose.apply(expr::Op::multiply, {compose.number(std::to_string(k)), power}));
}

/// A value of the Chebyshev polynomials of the interval: of degree k, or its derivative.
expr::Program chebyshev_program(const std::string& variable, int k, bool derivative,
                                const Range& in, const Place& place) {
  expr::Composer compose(place);
  const int s = compose.input(variable);
  const int low = compose.program(in.low.program);
  const int high = compose.program(in.high.program);
  expr::Chebyshev polynomials([&](const std::string& decimal) { return compose.number(decimal); },
                              [&](expr::Op op, std::vector<int> operands) {
                                return compose.apply(op, std::move(operands));
                              },
                              s, low, high);
  return compose.take(derivative ? polynomials.derivative(k) : polynomials.value(k));
}

}  // namespace

Basis monomials(const std::string& variable, int degree, const Place& place) {
  Basis basis;
  for (int k = 0; k <= degree; ++k) {
    basis.elements.push_back(power(variable, k, place));
    basis.texts.push_back(power_text(variable, k));
    if (k > 0) basis.derivatives.push_back(power_derivative(variable, k, place));
  }
  return basis;
}

Basis chebyshev(const std::string& variable, int degree, const Range& in, const Place& place) {
  Basis basis;
  basis.kind = Basis::Kind::chebyshev;
  basis.elements.emplace_back();
  basis.texts.emplace_back();
  for (int k = 1; k <= degree; ++k) {
    basis.elements.push_back(chebyshev_program(variable, k, false, in, place));
    basis.texts.push_back("chebyshev(" + std::to_string(k) + ", " + variable + ", " + in.low.text +
                          ", " + in.high.text + ")");
    basis.derivatives.push_back(chebyshev_program(variable, k, true, in, place));
  }
  return basis;
}

Basis basis_of(const Design::Unknown& unknown, std::size_t size) {
  const int degree = static_cast<int>(size) - 1;
  return unknown.in ? chebyshev(unknown.variable, degree, *unknown.in, unknown.place)
                    : monomials(unknown.variable, degree, unknown.place);
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
      sum += basis.kind == Basis::Kind::weights ? factor + "*" + coefficient
                                                : coefficient + "*" + factor;
    }
  }
  return sum;
}

expr::Body Function::body() const {
  return {variable, expr::combination(basis.elements, coefficients(), shape, place)};
}

expr::Body Function::derivative() const {
  const auto names = coefficients();
  if (names.size() == 1) {
    expr::Composer compose(place);
    return {variable, compose.take(compose.apply(expr::Op::zeros, {}, shape))};
  }
  return {variable,
          expr::combination(basis.derivatives, {names.begin() + 1, names.end()}, shape, place)};
}

Bodies::Bodies(const std::vector<Function>& functions) {
  for (const Function& function : functions) set(function);
}

void Bodies::set(const Function& function) {
  set(function.name, function.body());
  if (function.basis.derivatives.size() + 1 == function.size())
    set(expr::derivative_name(function.name), function.derivative());
}

void Bodies::set(const std::string& name, expr::Body body) {
  bodies_.erase(expr::derivative_name(name));
  bodies_.insert_or_assign(name, std::move(body));
}

const expr::Body& Bodies::body(const std::string& name, const expr::Instruction& call) const {
  const auto found = bodies_.find(name);
  if (found != bodies_.end()) return found->second;
  if (expr::is_derivative(name))
    throw InputError(call.place(), "the " + name +
                                       " is not known: only a polynomial has one here, not a "
                                       "function that is given at the vertices of a box, or by a "
                                       "text of its own in a gain file");
  throw std::logic_error("the function " + name + " has no body");
}

expr::Program Bodies::link(const expr::Program& program) const {
  return expr::link(
      program, [&](const std::string& name, const expr::Instruction& call) -> const expr::Body& {
        return body(name, call);
      });
}

}  // namespace gainsmith::model
