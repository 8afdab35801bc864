// What the equations of a program say of the unknowns u alone.
#include <algorithm>
#include <cmath>
#include <map>

#include "numbers/rational_algebra.h"
#include "numerics/lattice.h"
#include "sos/identity.h"

namespace gainsmith::sos {

using Eigen::Index;
using numbers::RationalMatrix;

std::vector<Equation> conditions_on_unknowns(const Program& program) {
  const Columns columns(program);
  const std::vector<Equation> equations = equations_of(program);
  std::map<int, int> uses;
  for (const Equation& equation : equations)
    for (const auto& [column, c] : equation.terms) ++uses[column];
  std::vector<const Equation*> bound;
  for (const Equation& equation : equations) {
    const bool has_own = std::ranges::any_of(equation.terms, [&](const auto& term) {
      return term.first >= columns.unknowns() && uses[term.first] == 1;
    });
    if (!has_own) bound.push_back(&equation);
  }
  // Of A A', A over t and the elements of Gram matrices, the kernel is that of A'.
  const auto m = static_cast<Index>(bound.size());
  std::map<int, std::vector<std::pair<Index, Rational>>> by_column;
  for (Index i = 0; i < m; ++i)
    for (const auto& [column, c] : bound[static_cast<std::size_t>(i)]->terms)
      if (column >= columns.unknowns()) by_column[column].emplace_back(i, c);
  RationalMatrix G = RationalMatrix::Zero(m, m);
  for (const auto& [column, terms] : by_column)
    for (const auto& [i, c] : terms)
      for (const auto& [j, d] : terms) G(i, j) += c * d;
  const RationalMatrix kernel = numbers::rational_kernel(G);
  std::vector<Equation> result;
  for (Index k = 0; k < kernel.cols(); ++k) {
    Equation sum;
    for (Index i = 0; i < m; ++i) {
      if (kernel(i, k) == 0) continue;
      const Equation& equation = *bound[static_cast<std::size_t>(i)];
      sum.value += kernel(i, k) * equation.value;
      for (const auto& [column, c] : equation.terms)
        if (column < columns.unknowns()) sum.terms[column] += kernel(i, k) * c;
    }
    std::erase_if(sum.terms, [](const auto& term) { return term.second == 0; });
    if (!sum.terms.empty() || sum.value != 0) result.push_back(std::move(sum));
  }
  return result;
}

std::optional<std::vector<Rational>> decimals_near(const std::vector<double>& u,
                                                   const std::vector<Equation>& conditions) {
  double largest = 0;
  for (const double value : u) {
    if (!std::isfinite(value)) return std::nullopt;
    largest = std::max(largest, std::abs(value));
  }
  constexpr int kDigits = 14;
  const int decimals =
      largest > 0 ? kDigits - static_cast<int>(std::ceil(std::log10(largest))) : kDigits;
  const Rational unit = power_of_ten(decimals);
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
