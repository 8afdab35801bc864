#include "lmi/polished_multipliers.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "base/eigen_scalars.h"

namespace gainsmith::lmi {

namespace {

using Eigen::Index;
using Wide = numbers::MatrixOf<Decimal100>;
using Narrow = numbers::MatrixOf<DoubleDouble>;
using numbers::times;

constexpr double kSettled = 1e-80;  // of W_i; 100 digits leave less than this of a sum

Narrow narrow(const Wide& matrix) {
  return matrix.unaryExpr([](const Decimal100& x) { return as<DoubleDouble>(x); });
}

double size_of(const Decimal100& x) { return std::abs(as<double>(x)); }

/// r_i and W_i = sum <|B_ki|, |Y_k|>, the scale of r_i.
struct Residuals {
  std::vector<Decimal100> r;
  std::vector<double> W;

  explicit Residuals(int unknowns) : r(static_cast<std::size_t>(unknowns) + 1), W(r.size(), 0) {}

  void add(const ExactBlock<Decimal100>& block, const Wide& Y) {
    for (const auto& [i, B] : block.terms) {
      const auto at = static_cast<std::size_t>(i);
      for (Index e = 0; e < B.mid.size(); ++e) {
        if (B.mid(e) == 0) continue;
        const Decimal100 term = B.mid(e) * Y(e);
        r[at] += term;
        W[at] += size_of(term);
      }
    }
  }

  double share(std::size_t i) const { return W[i] > 0 ? as<double>(r[i]) / W[i] : 0; }
};

Residuals residuals_of(const std::vector<WideMultiplier>& multipliers, int unknowns) {
  Residuals residuals(unknowns);
  for (const WideMultiplier& one : multipliers) residuals.add(*one.block, one.Y);
  return residuals;
}

/// lambda with G lambda = r over `rows`, in units in which G has the diagonal 1. Rows that depend
/// on those before them, up to rounding, have lambda = 0.
std::vector<DoubleDouble> solve(const Narrow& G, const std::vector<DoubleDouble>& r) {
  using std::sqrt;
  constexpr double kDependent = 1e-22;
  const Index m = G.rows();
  Narrow L = Narrow::Constant(m, m, DoubleDouble(0));
  std::vector<bool> kept(static_cast<std::size_t>(m), false);
  const auto is_kept = [&](Index i) { return kept[static_cast<std::size_t>(i)]; };
  for (Index j = 0; j < m; ++j) {
    DoubleDouble pivot = G(j, j);
    for (Index k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    if (!(pivot > DoubleDouble(kDependent))) continue;
    kept[static_cast<std::size_t>(j)] = true;
    L(j, j) = sqrt(pivot);
    for (Index i = j + 1; i < m; ++i) {
      DoubleDouble sum = G(i, j);
      for (Index k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum / L(j, j);
    }
  }
  std::vector<DoubleDouble> x(r);
  for (Index i = 0; i < m; ++i) {
    DoubleDouble& value = x[static_cast<std::size_t>(i)];
    if (!is_kept(i)) {
      value = DoubleDouble(0);
      continue;
    }
    for (Index k = 0; k < i; ++k) value -= L(i, k) * x[static_cast<std::size_t>(k)];
    value /= L(i, i);
  }
  for (Index i = m - 1; i >= 0; --i) {
    if (!is_kept(i)) continue;
    DoubleDouble& value = x[static_cast<std::size_t>(i)];
    for (Index k = i + 1; k < m; ++k)
      if (is_kept(k)) value -= L(k, i) * x[static_cast<std::size_t>(k)];
    value /= L(i, i);
  }
  return x;
}

/// G over all unknowns, and 0 of the constant part.
Narrow gram(const std::vector<WideMultiplier>& multipliers, int unknowns) {
  Narrow G = Narrow::Constant(unknowns + 1, unknowns + 1, DoubleDouble(0));
  for (const WideMultiplier& one : multipliers) {
    const Narrow Y = narrow(one.Y);
    std::vector<Narrow> B;
    for (const auto& [i, matrix] : one.block->terms) B.push_back(narrow(matrix.mid));
    for (std::size_t a = 0; a < B.size(); ++a) {
      const Narrow moved = times<DoubleDouble>(B[a], Y);
      for (std::size_t b = a; b < B.size(); ++b) {
        DoubleDouble sum(0);
        for (Index e = 0; e < moved.size(); ++e) sum += moved(e) * B[b](e);
        const int i = one.block->terms[a].first;
        const int j = one.block->terms[b].first;
        G(i, j) += sum;
        if (i != j) G(j, i) += sum;
      }
    }
  }
  return G;
}

/// lambda of all unknowns, 0 for those without an equation.
std::vector<DoubleDouble> step(const std::vector<WideMultiplier>& multipliers,
                               const Residuals& residuals, bool with_constant) {
  using std::sqrt;
  const auto unknowns = static_cast<int>(residuals.r.size()) - 1;
  const Narrow G = gram(multipliers, unknowns);
  std::vector<int> rows;
  for (int i = with_constant ? 0 : 1; i <= unknowns; ++i)
    if (G(i, i) > DoubleDouble(0)) rows.push_back(i);
  const auto m = static_cast<Index>(rows.size());
  Narrow scaled(m, m);
  std::vector<DoubleDouble> units, r;
  for (const int i : rows) units.push_back(DoubleDouble(1) / sqrt(G(i, i)));
  for (std::size_t a = 0; a < rows.size(); ++a) {
    r.push_back(as<DoubleDouble>(residuals.r[static_cast<std::size_t>(rows[a])]) * units[a]);
    for (std::size_t b = 0; b < rows.size(); ++b)
      scaled(static_cast<Index>(a), static_cast<Index>(b)) =
          G(rows[a], rows[b]) * units[a] * units[b];
  }
  const std::vector<DoubleDouble> solved = solve(scaled, r);
  std::vector<DoubleDouble> lambda(residuals.r.size(), DoubleDouble(0));
  for (std::size_t a = 0; a < rows.size(); ++a)
    lambda[static_cast<std::size_t>(rows[a])] = solved[a] * units[a];
  return lambda;
}

/// Y <- M Y M; false when Y changes by more than a half. M itself may be large where Y is nearly 0.
bool move(WideMultiplier& one, const std::vector<DoubleDouble>& lambda) {
  constexpr double kMost = 0.5;
  const Index n = one.Y.rows();
  Wide change = Wide::Zero(n, n);  // Lambda / 2
  for (const auto& [i, B] : one.block->terms) {
    const DoubleDouble& factor = lambda[static_cast<std::size_t>(i)];
    if (factor == DoubleDouble(0)) continue;
    const Decimal100 half = as<Decimal100>(factor) / 2;
    for (Index e = 0; e < change.size(); ++e)
      if (B.mid(e) != 0) change(e) += half * B.mid(e);
  }
  const Wide left = times<Decimal100>(change, one.Y);
  const Wide both = times<Decimal100>(left, change);
  const auto moved_by = as<double>(Decimal100(both.trace()));
  if (!(moved_by <= kMost * kMost * as<double>(Decimal100(one.Y.trace())))) return false;
  const Wide moved = one.Y - left - left.transpose() + both;
  one.Y = (moved + moved.transpose()) / Decimal100(2);
  return true;
}

/// r' G^-1 r.
double decrement(const std::vector<DoubleDouble>& lambda, const Residuals& residuals) {
  double sum = 0;
  for (std::size_t i = 0; i < lambda.size(); ++i)
    sum += as<double>(DoubleDouble(lambda[i] * as<DoubleDouble>(residuals.r[i])));
  return sum;
}

}  // namespace

bool polish(std::vector<WideMultiplier>& multipliers, int unknowns) {
  constexpr int kMostSteps = 12;
  constexpr double kClear = 1e-6;    // r_0 below this share of W_0 is below 0 whatever is done
  constexpr double kSlowest = 0.25;  // what a step leaves of r' G^-1 r, where it squares
  constexpr int kFirst = 3;          // steps that may do worse
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kMostSteps; ++k) {
    const Residuals residuals = residuals_of(multipliers, unknowns);
    const bool with_constant = residuals.share(0) > -kClear;
    double worst = 0;
    for (std::size_t i = with_constant ? 0 : 1; i < residuals.r.size(); ++i)
      worst = std::max(worst, std::abs(residuals.share(i)));
    if (worst <= kSettled) return true;
    const auto lambda = step(multipliers, residuals, with_constant);
    const double size = decrement(lambda, residuals);
    if (k >= kFirst && !(size <= kSlowest * last)) return false;
    last = size;
    for (WideMultiplier& one : multipliers)
      if (!move(one, lambda)) return false;
  }
  return false;
}

}  // namespace gainsmith::lmi
