#include "lmi/balance.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/stop.h"
#include "lmi/balance_elements.h"
#include "lmi/free_rows.h"
#include "numbers/matrix.h"

namespace gainsmith::lmi {

namespace {

/// Logarithms of the units; rows that share them have one place.
struct Units {
  numbers::Vector rows;
  std::vector<double> unknowns;  ///< [0] is the constant's, 0

  double balanced(int unknown, const BalanceElements::Element& e) const {
    return e.log + rows[e.first] + rows[e.second] + unknowns[static_cast<std::size_t>(unknown)];
  }
};

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The normal equations over the rows, N s = b, without the unknowns: given the rows, log2 d_i is
/// minus the mean of its elements. N = G - W D^-1 W', G of the elements, W(r, i) what the elements
/// of unknown i in row r weigh, D_i what all of them do.
class NormalEquations {
 public:
  explicit NormalEquations(const BalanceElements& elements)
      : right_(numbers::Vector::Zero(elements.rows())),
        weights_(numbers::Vector::Zero(elements.unknowns() + 1)),
        logs_(weights_) {
    std::vector<Eigen::Triplet<double>> of_rows, of_unknowns;
    for (int i = 0; i <= elements.unknowns(); ++i) {
      check_stop();
      elements.for_each(i, [&](const BalanceElements::Element& e, double weight) {
        for (const auto& [a, b] : {std::pair(e.first, e.second), std::pair(e.second, e.first)}) {
          of_rows.emplace_back(a, a, weight);
          of_rows.emplace_back(a, b, weight);
          right_[a] -= weight * e.log;
          if (i > 0) of_unknowns.emplace_back(a, i, weight);
        }
        if (i > 0) weights_[i] += weight;
        logs_[i] += weight * e.log;
      });
    }
    G_.resize(right_.size(), right_.size());
    G_.setFromTriplets(of_rows.begin(), of_rows.end());
    W_.resize(right_.size(), weights_.size());
    W_.setFromTriplets(of_unknowns.begin(), of_unknowns.end());
    right_ += W_ * means(logs_);
    fixed_ = numbers::Vector::Ones(right_.size());
    for (const int row : free_rows(elements)) fixed_[row] = 0;
  }

  /// By conjugate gradients, as Curtis and Reid do, with the diagonal as preconditioner; free rows
  /// are 0.
  Units solve() const {
    constexpr double kEnough = 1e-28;  // of the squares: 1e-14 of the residual
    // 1 / N_rr, the preconditioner; 0 keeps free rows where they are.
    numbers::Vector scale =
        G_.diagonal() - W_.cwiseAbs2() * means(numbers::Vector::Ones(weights_.size()));
    scale = (fixed_.array() > 0).select(scale.cwiseInverse(), 0.0);
    numbers::Vector s = numbers::Vector::Zero(right_.size());
    numbers::Vector rest = right_, along = scale.cwiseProduct(rest);
    double size = rest.dot(along);
    const double enough = kEnough * size;
    for (Eigen::Index k = 0; k < 10 * s.size() && size > enough; ++k) {
      check_stop();
      const numbers::Vector image = G_ * along - W_ * means(W_.transpose() * along);
      const double curvature = along.dot(image);
      if (!(curvature > 0)) break;  // what is left is rounding
      const double step = size / curvature;
      s += step * along;
      rest -= step * image;
      const numbers::Vector next = scale.cwiseProduct(rest);
      const double size_of_next = rest.dot(next);
      along = next + size_of_next / size * along;
      size = size_of_next;
    }
    // Given the rows, log2 d_i is minus the mean of log2 |element| + log2 s_r + log2 s_c.
    const numbers::Vector unknowns = -means(logs_ + W_.transpose() * s);
    return {s, {unknowns.begin(), unknowns.end()}};
  }

 private:
  /// Divided by the weights; 0 of the constant, and of unknowns without elements.
  numbers::Vector means(const numbers::Vector& sums) const {
    return (weights_.array() > 0).select(sums.cwiseQuotient(weights_), 0.0);
  }

  SparseMatrix G_, W_;
  numbers::Vector right_, weights_, logs_;
  numbers::Vector fixed_;  ///< 0 of rows that are free
};

/// Without the elements below `least` in these units; none when there are no such elements.
std::optional<BalanceElements> without_small(const BalanceElements& elements, const Units& units,
                                             double least) {
  // The largest element of each row and of each unknown stays.
  const double small = std::log2(least);
  const double none = -std::numeric_limits<double>::infinity();
  std::vector<double> of_row(static_cast<std::size_t>(units.rows.size()), none);
  std::vector<double> of_unknown(units.unknowns.size(), none);
  bool some = false;
  for (int i = 0; i <= elements.unknowns(); ++i)
    elements.for_each(i, [&](const BalanceElements::Element& e, double) {
      const double size = units.balanced(i, e);
      some |= size < small;
      for (const int row : {e.first, e.second}) {
        double& largest = of_row[static_cast<std::size_t>(row)];
        largest = std::max(largest, size);
      }
      double& largest = of_unknown[static_cast<std::size_t>(i)];
      largest = std::max(largest, size);
    });
  if (!some) return std::nullopt;
  BalanceElements kept = elements.with([&](int i, const BalanceElements::Element& e) {
    const double size = units.balanced(i, e);
    return size >= small || size >= of_unknown[static_cast<std::size_t>(i)] ||
           size >= of_row[static_cast<std::size_t>(e.first)] ||
           size >= of_row[static_cast<std::size_t>(e.second)];
  });
  if (kept.size() == elements.size()) return std::nullopt;
  return kept;
}

/// The power of two of a unit. Exact halves stay clear of the border 0.4863 (balance.h).
int rounded(double exponent) { return static_cast<int>(std::floor(exponent + 0.5137)); }

}  // namespace

double Balance::factor(std::size_t block, int r, int c, int unknown) const {
  const std::vector<int>& exponents = rows[block];
  return std::ldexp(1.0, exponents[static_cast<std::size_t>(r)] +
                             exponents[static_cast<std::size_t>(c)] +
                             (unknown == 0 ? 0 : unknowns[static_cast<std::size_t>(unknown) - 1]));
}

double Balance::unit(int unknown) const {
  return std::ldexp(1.0, unknowns[static_cast<std::size_t>(unknown) - 1]);
}

double Balance::row(std::size_t block, int r) const {
  return std::ldexp(1.0, rows[block][static_cast<std::size_t>(r)]);
}

Balance balance(const std::vector<const Block*>& blocks, int unknowns,
                const std::vector<double>& objective) {
  const BalanceElements elements(blocks, unknowns, objective);
  Units units = NormalEquations(elements).solve();
  // What the second and the third pass leave out, see balance.h.
  constexpr double kNoise = 1e-8, kSmall = 1e-3;
  std::optional<BalanceElements> kept = without_small(elements, units, kNoise);
  if (kept) units = NormalEquations(*kept).solve();
  if (const auto large = without_small(kept ? *kept : elements, units, kSmall))
    units = NormalEquations(*large).solve();
  Balance result;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    std::vector<int>& of_block = result.rows.emplace_back();
    for (int r = 0; r < blocks[k]->size; ++r)
      of_block.push_back(rounded(units.rows[elements.first_row(k) + r]));
  }
  for (int i = 1; i <= unknowns; ++i)
    result.unknowns.push_back(rounded(units.unknowns[static_cast<std::size_t>(i)]));
  return result;
}

}  // namespace gainsmith::lmi
