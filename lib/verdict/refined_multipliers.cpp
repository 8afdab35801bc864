#include "verdict/refined_multipliers.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/eigen_scalars.h"
#include "numbers/dense.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::times;

constexpr double kSettled = 1e-78;  // of W_i; far above the rounding of 100 digits
constexpr double kEnough = 1e-72;   // where steps lead no further

/// r_i and its scale W_i = sum |B_ki|_ab sqrt(Y_aa Y_bb), which does not vanish where elements of Y
/// have to.
struct Residuals {
  std::vector<Decimal100> r;
  std::vector<double> W;

  explicit Residuals(int unknowns) : r(static_cast<std::size_t>(unknowns) + 1), W(r.size(), 0) {}

  void add(const ExactBlock<Decimal100>& block, const Wide& Y) {
    const Index n = Y.rows();
    numbers::Vector size(n);
    for (Index a = 0; a < n; ++a) size[a] = std::sqrt(size_of(Y(a, a)));
    for (const auto& [i, elements] : block.terms) {
      const auto at = static_cast<std::size_t>(i);
      spend(static_cast<double>(elements.size()) * kWideWork);
      for (const auto& e : elements) {
        r[at] += e.mid * Y(e.row, e.column);
        W[at] += size_of(e.mid) * size[e.row] * size[e.column];
      }
    }
  }

  double share(std::size_t i) const { return W[i] > 0 ? as<double>(r[i]) / W[i] : 0; }
};

Residuals residuals_of(const std::vector<FactoredMultiplier>& multipliers, int unknowns) {
  Residuals residuals(unknowns);
  for (const FactoredMultiplier& one : multipliers) residuals.add(*one.block, one.value());
  return residuals;
}

/// lambda with G lambda = r over `rows`, in units in which G has the diagonal 1. Rows that depend
/// on those before them, up to rounding, have lambda = 0.
template <class S>
std::vector<S> solve(const numbers::MatrixOf<S>& G, const std::vector<S>& r) {
  using std::sqrt;
  constexpr double kDependent = std::is_same_v<S, DoubleDouble> ? 1e-22 : 1e-85;
  const Index m = G.rows();
  numbers::MatrixOf<S> L = numbers::MatrixOf<S>::Constant(m, m, S(0));
  std::vector<bool> kept(static_cast<std::size_t>(m), false);
  const auto is_kept = [&](Index i) { return kept[static_cast<std::size_t>(i)]; };
  for (Index j = 0; j < m; ++j) {
    spend(static_cast<double>((m - j) * j) * work_of<S>());
    S pivot = G(j, j);
    for (Index k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    if (!(pivot > S(kDependent))) continue;
    kept[static_cast<std::size_t>(j)] = true;
    L(j, j) = sqrt(pivot);
    for (Index i = j + 1; i < m; ++i) {
      S sum = G(i, j);
      for (Index k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum / L(j, j);
    }
  }
  std::vector<S> x(r);
  for (Index i = 0; i < m; ++i) {
    S& value = x[static_cast<std::size_t>(i)];
    if (!is_kept(i)) {
      value = S(0);
      continue;
    }
    for (Index k = 0; k < i; ++k) value -= L(i, k) * x[static_cast<std::size_t>(k)];
    value /= L(i, i);
  }
  for (Index i = m - 1; i >= 0; --i) {
    if (!is_kept(i)) continue;
    S& value = x[static_cast<std::size_t>(i)];
    for (Index k = i + 1; k < m; ++k)
      if (is_kept(k)) value -= L(k, i) * x[static_cast<std::size_t>(k)];
    value /= L(i, i);
  }
  return x;
}

/// G_ij = sum <B_i L, B_j L> over all unknowns, and 0 of the constant part.
template <class S>
numbers::MatrixOf<S> gram(const std::vector<FactoredMultiplier>& multipliers, int unknowns) {
  numbers::MatrixOf<S> G = numbers::MatrixOf<S>::Constant(unknowns + 1, unknowns + 1, S(0));
  for (const FactoredMultiplier& one : multipliers) {
    const numbers::MatrixOf<S> L = narrow<S>(one.L);
    std::vector<numbers::MatrixOf<S>> moved;
    for (const auto& [i, elements] : one.block->terms) {
      numbers::MatrixOf<S> product = numbers::MatrixOf<S>::Constant(L.rows(), L.cols(), S(0));
      for (const auto& e : elements) product.row(e.row) += as<S>(e.mid) * L.row(e.column);
      moved.push_back(std::move(product));
    }
    const auto terms = static_cast<double>(moved.size());
    for (std::size_t a = 0; a < moved.size(); ++a) {
      spend((terms - static_cast<double>(a)) * static_cast<double>(L.size()) * work_of<S>());
      for (std::size_t b = a; b < moved.size(); ++b) {
        S sum(0);
        for (Index e = 0; e < L.size(); ++e) sum += moved[a](e) * moved[b](e);
        const int i = one.block->terms[a].first;
        const int j = one.block->terms[b].first;
        G(i, j) += sum;
        if (i != j) G(j, i) += sum;
      }
    }
  }
  return G;
}

/// lambda of all unknowns, 0 for those without an equation; (G + damping I) lambda = r.
template <class S>
std::vector<Decimal100> step(const std::vector<FactoredMultiplier>& multipliers,
                             const Residuals& residuals, bool with_constant, double damping) {
  using std::sqrt;
  const auto unknowns = static_cast<int>(residuals.r.size()) - 1;
  const numbers::MatrixOf<S> G = gram<S>(multipliers, unknowns);
  std::vector<int> rows;
  for (int i = with_constant ? 0 : 1; i <= unknowns; ++i)
    if (G(i, i) > S(0)) rows.push_back(i);
  const auto m = static_cast<Index>(rows.size());
  numbers::MatrixOf<S> scaled(m, m);
  std::vector<S> units, r;
  for (const int i : rows) units.push_back(S(1) / sqrt(G(i, i)));
  for (std::size_t a = 0; a < rows.size(); ++a) {
    r.push_back(as<S>(residuals.r[static_cast<std::size_t>(rows[a])]) * units[a]);
    for (std::size_t b = 0; b < rows.size(); ++b)
      scaled(static_cast<Index>(a), static_cast<Index>(b)) =
          G(rows[a], rows[b]) * units[a] * units[b];
  }
  for (Index a = 0; a < m; ++a) scaled(a, a) += S(damping);
  const std::vector<S> solved = solve<S>(scaled, r);
  std::vector<Decimal100> lambda(residuals.r.size(), Decimal100(0));
  for (std::size_t a = 0; a < rows.size(); ++a)
    lambda[static_cast<std::size_t>(rows[a])] = as<Decimal100>(S(solved[a] * units[a]));
  return lambda;
}

/// L <- L - 1/2 sum lambda_i B_i L; false when L changes by more than a half.
bool move(FactoredMultiplier& one, const std::vector<Decimal100>& lambda) {
  constexpr double kMost = 0.5;
  const Index n = one.L.rows();
  Wide change = Wide::Zero(n, n);
  for (const auto& [i, elements] : one.block->terms) {
    const Decimal100& factor = lambda[static_cast<std::size_t>(i)];
    if (factor == 0) continue;
    spend(static_cast<double>(elements.size()) * kWideWork);
    const Decimal100 half = factor / 2;
    for (const auto& e : elements) change(e.row, e.column) += half * e.mid;
  }
  const Wide moved = times<Decimal100>(change, one.L);
  const auto square = [](const Wide& M) {
    Decimal100 sum(0);
    for (Index e = 0; e < M.size(); ++e) sum += M(e) * M(e);
    return as<double>(sum);
  };
  if (!(square(moved) <= kMost * kMost * square(one.L))) return false;
  one.L -= moved;
  return true;
}

/// How far the multipliers are from a certificate, and with which equations they become one.
struct Distance {
  bool with_constant = true;  ///< r_0 is not clearly below 0, and must become 0
  double worst = 0;           ///< of |r_i| / W_i

  explicit Distance(const Residuals& residuals) {
    constexpr double kClear = 1e-6;  // r_0 below this share of W_0 is below 0 whatever is done
    with_constant = residuals.share(0) > -kClear;
    for (std::size_t i = with_constant ? 0 : 1; i < residuals.r.size(); ++i)
      worst = std::max(worst, std::abs(residuals.share(i)));
  }
};

/// How the steps go on.
struct Way {
  int most_steps = 0;
  int patience = 0;       ///< steps in which the worst residual must fall tenfold
  bool on_range = false;  ///< damped

  /// Whether a step that left this share of the residual was one towards a double root, where it
  /// leaves a quarter.
  bool is_towards_double_root(double share) const {
    return on_range ? share > 0.1 : share > 0.2 && share < 0.3;
  }
};

/// The equations of a step in double: M_k with the elements of all B_ki L_k as its columns, and the
/// factor of G = sum M_k' M_k in units in which its diagonal is 1.
class StepInDouble {
 public:
  StepInDouble(const std::vector<FactoredMultiplier>& multipliers, int unknowns, bool with_constant)
      : units_(numbers::Vector::Zero(unknowns + 1)) {
    constexpr double kDamping = 1e-14;
    numbers::Matrix G = numbers::Matrix::Zero(unknowns + 1, unknowns + 1);
    for (const FactoredMultiplier& one : multipliers) {
      moved_.push_back(images_of(one, unknowns));
      if (moved_.back().rows() == 0) continue;
      const auto m = static_cast<double>(unknowns);
      spend(m * m * static_cast<double>(moved_.back().rows()) * kBlockWork);
      G.selfadjointView<Eigen::Lower>().rankUpdate(moved_.back().transpose());
    }
    for (Index i = with_constant ? 0 : 1; i <= unknowns; ++i)
      if (G(i, i) > 0) units_[i] = 1 / std::sqrt(G(i, i));
    G.triangularView<Eigen::StrictlyUpper>() = G.transpose();
    G_ = units_.asDiagonal() * G * units_.asDiagonal();
    numbers::Matrix damped = G_;
    // An unknown without an equation has a row of zeros, and lambda = 0.
    for (Index i = 0; i <= unknowns; ++i)
      damped(i, i) = units_[i] > 0 ? 1 + kDamping * static_cast<double>(unknowns + 1) : 1;
    spend(std::pow(static_cast<double>(unknowns), 3) / 3 * kBlockWork);
    factor_.emplace(damped);
  }

  explicit operator bool() const { return static_cast<bool>(*factor_); }

  /// Moves the factors by the step for r; false when one changes by more than a half.
  bool move(const Residuals& residuals, double scale,
            std::vector<FactoredMultiplier>& multipliers) const {
    constexpr int kRefinements = 3;
    constexpr double kMost = 0.5;
    numbers::Vector r(units_.size());
    for (Index i = 0; i < r.size(); ++i)
      r[i] = units_[i] * as<double>(Decimal100(residuals.r[static_cast<std::size_t>(i)] / scale));
    numbers::Vector lambda = numbers::Vector::Zero(r.size());
    for (int k = 0; k < kRefinements; ++k) lambda += factor_->solve(r - G_ * lambda);
    lambda.array() *= units_.array() / 2;
    for (std::size_t k = 0; k < multipliers.size(); ++k) {
      Wide& L = multipliers[k].L;
      if (L.size() == 0) continue;
      const numbers::Vector change = moved_[k] * lambda;
      if (!(scale * change.norm() <= kMost * narrow<double>(L).norm())) return false;
      for (Index e = 0; e < L.size(); ++e) L(e) -= Decimal100(change[e]) * scale;
    }
    return true;
  }

 private:
  static numbers::Matrix images_of(const FactoredMultiplier& one, int unknowns) {
    const numbers::Matrix L = narrow<double>(one.L);
    numbers::Matrix images = numbers::Matrix::Zero(L.size(), unknowns + 1);
    numbers::Matrix image(L.rows(), L.cols());
    for (const auto& [i, elements] : one.block->terms) {
      spend(static_cast<double>(elements.size()) * static_cast<double>(L.cols()) * kDoubleWork);
      image.setZero();
      for (const auto& e : elements) image.row(e.row) += as<double>(e.mid) * L.row(e.column);
      images.col(i) = image.reshaped();
    }
    return images;
  }

  numbers::Vector units_;
  std::vector<numbers::Matrix> moved_;
  numbers::Matrix G_;
  std::optional<numbers::Cholesky> factor_;
};

bool follow(std::vector<FactoredMultiplier>& multipliers, int unknowns, const Way& way) {
  constexpr double kFalls = 0.1;
  constexpr double kNarrow = 1e-8;  // as far as 31 digits solve the equations of a double root
  constexpr double kDamping = 1.5;  // between |r|^2 of the scale of Y and |r| of a double root
  double last = std::numeric_limits<double>::infinity();
  double best = last;
  int found = 0;
  bool doubled = false;
  for (int k = 0; k <= way.most_steps; ++k) {
    const Residuals residuals = residuals_of(multipliers, unknowns);
    const Distance distance(residuals);
    if (distance.worst <= kSettled) return true;
    if (distance.worst <= kFalls * best) {
      best = distance.worst;
      found = k;
    }
    if (!(k - found < way.patience)) return distance.worst <= kEnough;
    const double damping = way.on_range ? std::pow(distance.worst, kDamping) : 0;
    auto lambda = distance.worst > kNarrow
                      ? step<DoubleDouble>(multipliers, residuals, distance.with_constant, damping)
                      : step<Decimal100>(multipliers, residuals, distance.with_constant, damping);
    // To a double root the steps cover half of the distance: then one covers all of it.
    doubled = !doubled && k > 0 && way.is_towards_double_root(distance.worst / last);
    if (doubled)
      for (Decimal100& value : lambda) value *= 2;
    last = distance.worst;
    if (!std::all_of(multipliers.begin(), multipliers.end(),
                     [&](FactoredMultiplier& one) { return move(one, lambda); }))
      return false;
  }
  return false;
}

}  // namespace

numbers::MatrixOf<Decimal100> FactoredMultiplier::value() const {
  return times<Decimal100>(L, Wide(L.transpose()));
}

numbers::MatrixOf<Decimal100> factor_above(const numbers::MatrixOf<Decimal100>& Y, double least) {
  const Index n = Y.rows();
  Wide rest = Y;
  Wide L(n, n);
  Index rank = 0;
  for (; rank < n; ++rank) {
    Index best = 0;
    for (Index i = 1; i < n; ++i)
      if (rest(i, i) > rest(best, best)) best = i;
    if (!(rest(best, best) > Decimal100(least))) break;
    L.col(rank) = rest.col(best) / sqrt(rest(best, best));
    rest -= times<Decimal100>(Wide(L.col(rank)), Wide(L.col(rank).transpose()));
  }
  return L.leftCols(rank);
}

bool refine_in_double(std::vector<FactoredMultiplier>& multipliers, int unknowns) {
  constexpr int kMostSteps = 40;
  constexpr double kFails = 0.5, kSlow = 1e-3;
  double last = std::numeric_limits<double>::infinity();
  std::optional<StepInDouble> step;
  for (int k = 0; k < kMostSteps; ++k) {
    const Residuals residuals = residuals_of(multipliers, unknowns);
    const Distance distance(residuals);
    if (distance.worst <= kSettled) return true;
    if (!(distance.worst <= kFails * last)) return distance.worst <= kEnough;
    if (!step || distance.worst > kSlow * last)
      step.emplace(multipliers, unknowns, distance.with_constant);
    if (!*step) return false;
    last = distance.worst;
    if (!step->move(residuals, distance.worst, multipliers)) return false;
  }
  return false;
}

bool refine(std::vector<FactoredMultiplier>& multipliers, int unknowns) {
  return follow(multipliers, unknowns, {80, 3, false});
}

bool refine_on_range(std::vector<FactoredMultiplier>& multipliers, int unknowns) {
  return follow(multipliers, unknowns, {150, 10, true});
}

}  // namespace gainsmith::verdict
