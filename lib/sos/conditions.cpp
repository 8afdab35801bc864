// What the equations of a program say of the unknowns u alone.
#include <map>

#include "base/stop.h"
#include "numbers/matrix.h"
#include "numerics/lattice.h"
#include "sos/identity.h"
#include "sos/reduce.h"

namespace gainsmith::sos {

using Eigen::Index;
using numbers::RationalMatrix;

// Elimination from the last column on: u come first, so an equation whose last column is one of u
// is a combination without t and Gram matrices.
std::vector<Equation> conditions_on_unknowns(const Program& program) {
  std::vector<Equation> result;
  std::map<int, Pivot> pivots;
  for (Equation& equation : equations_of(program)) {
    check_stop();
    const auto last = [&] { return equation.terms.empty() ? -1 : equation.terms.rbegin()->first; };
    auto pivot = pivots.find(last());
    for (; pivot != pivots.end(); pivot = pivots.find(last())) pivot->second.put_into(equation);
    if (last() >= program.unknowns)
      pivots[last()] = {last(), equation};
    else if (last() >= 0 || equation.value != 0)
      result.push_back(std::move(equation));
  }
  return result;
}

std::optional<std::vector<Rational>> decimals_near(const std::vector<double>& u,
                                                   const std::vector<Equation>& conditions) {
  const auto all = numbers::Vector::Map(u.data(), std::ssize(u));
  if (!all.allFinite()) return std::nullopt;
  constexpr int kDigits = 14;
  // Whole multiples X of 1/unit with A X = b unit, near u unit.
  const Rational unit = power_of_ten(decimals_for(all.lpNorm<Eigen::Infinity>(), kDigits));
  const auto rows = static_cast<Index>(conditions.size());
  RationalMatrix A = RationalMatrix::Zero(rows, std::ssize(u)), b(rows, 1);
  for (Index i = 0; i < rows; ++i) {
    const Equation& condition = conditions[static_cast<std::size_t>(i)];
    for (const auto& [column, c] : condition.terms) A(i, column) = c;
    b(i) = condition.value * unit;
  }
  std::vector<Rational> near;
  for (const double value : u) near.push_back(Rational(value) * unit);
  const auto whole = numerics::whole_solution(A, b, near);
  if (!whole) return std::nullopt;
  std::vector<Rational> result;
  for (const Integer& value : *whole) result.push_back(Rational(value) / unit);
  return result;
}

}  // namespace gainsmith::sos
