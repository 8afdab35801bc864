#include "verdict/weak_duality.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/unit_roundoff.h"
#include "lmi/assembler.h"
#include "numbers/dense/dense.h"
#include "verdict/exactness.h"
#include "verdict/wide_algebra.h"

namespace gainsmith::verdict {

namespace {

using Eigen::Index;
using numbers::Matrix;
using numbers::Vector;
using Quad = numbers::MatrixOf<DoubleDouble>;
using BlockList = std::vector<ExactBlock<DoubleDouble>>;

/// Multipliers that are not 0, with factors near them that tell their sizes.
struct Factored {
  std::vector<FactoredBlock<DoubleDouble>> blocks;
  std::vector<Quad> Y;
};

/// Y_k + lift tr(Y_k)/n I and its Cholesky factor in double; none where that is not positive
/// definite. Multipliers with a trace of 0 are left out.
std::optional<Factored> factors_of(const BlockList& blocks, const Multipliers& Y, double lift) {
  Factored result;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (!(Y[k].trace() > DoubleDouble(0))) continue;
    Quad y = Y[k];
    y.diagonal().array() += DoubleDouble(lift / static_cast<double>(y.rows())) * y.trace();
    const numbers::Cholesky factor(
        y.unaryExpr([](const DoubleDouble& x) { return as<double>(x); }));
    if (!factor) return std::nullopt;
    result.blocks.push_back({&blocks[k], factor.lower()});
    result.Y.push_back(std::move(y));
  }
  return result;
}

/// r_i, r_0 = c_0 - sum_k <B_k0, Y_k> among them.
ResidualsInDouble slacks_of(const Factored& of, const Costs& costs) {
  constexpr double kRounding = 1e-24;  // more than a million operations in 31 digits leave
  std::vector<DoubleDouble> r;
  Vector error(std::ssize(costs));
  for (Index i = 0; i < error.size(); ++i) {
    const auto& c = costs[static_cast<std::size_t>(i)];
    r.push_back(c.mid);
    error[i] = c.rad + kRounding * upper(c.mid);
  }
  for (std::size_t k = 0; k < of.Y.size(); ++k)
    for (const auto& [i, elements] : of.blocks[k].block->terms)
      for (const auto& e : elements) {
        const DoubleDouble& y = of.Y[k](e.row, e.column);
        r[static_cast<std::size_t>(i)] -= e.mid * y;
        error[i] += (kRounding * upper(e.mid) + e.rad) * upper(y) * (1 + 1e-12);
      }
  Vector rounded(error.size());
  for (Index i = 0; i < error.size(); ++i) {
    rounded[i] = as<double>(r[static_cast<std::size_t>(i)]);
    error[i] += 2 * kUnitRoundoff * std::abs(rounded[i]);
  }
  return {rounded, error};
}

/// Y_k - theta L_k L_k' >= 0: a factor of a little less in 31 digits.
bool leaves_positive(const Factored& of, double theta) {
  constexpr double kRounding = 1e-25;  // n (n + 2) of 31 digits
  for (std::size_t k = 0; k < of.Y.size(); ++k) {
    const Quad L = of.blocks[k].L.cast<DoubleDouble>();
    Quad rest = of.Y[k] - DoubleDouble(theta) * numbers::times<DoubleDouble>(L, L.transpose());
    rest.diagonal() -= DoubleDouble(kRounding) * of.Y[k].diagonal();
    if (!cholesky(rest)) return false;
  }
  return true;
}

/// Y_k + dY_k, dY_k = L_k W_k L_k' with W_k = sum_j (H^-1 r)_j L_k'B_kj L_k: the elements of G
/// times the steps, those off the diagonal by sqrt(2).
void correct(const Basis& by, const Vector& steps, Factored& of) {
  if (by.used.empty()) return;
  const Vector moved = by.G * steps;
  Index at = 0;
  for (std::size_t k = 0; k < of.Y.size(); ++k) {
    const Quad L = of.blocks[k].L.cast<DoubleDouble>();
    Quad W(L.cols(), L.cols());
    for (Index c = 0; c < W.cols(); ++c)
      for (Index r = c; r < W.cols(); ++r, ++at)
        W(r, c) = W(c, r) = DoubleDouble(r == c ? moved[at] : moved[at] / std::sqrt(2.0));
    of.Y[k] += numbers::times<DoubleDouble>(numbers::times<DoubleDouble>(L, W), L.transpose());
  }
}

BlockList blocks_of(const lmi::Inequalities& of, const lmi::Lmi& lmi, const lmi::GainBounds& bounds,
                    const lmi::Formulation& formulation) {
  const ExactBlocks<DoubleDouble> exact(of, formulation.balance);
  BlockList blocks;
  const auto add = [&](const lmi::Block& block, const std::vector<int>& kept) {
    blocks.push_back(exact.block(block, blocks.size(), kept));
  };
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    add(lmi.blocks[k], formulation.free_variables.kept[k]);
  for (const lmi::Block& block : bounds.blocks) add(block, lmi::all_rows(block));
  return blocks;
}

struct ShownBound {
  double value = 0;
  double loss = 0;  ///< that multipliers without a residual would not have
  Factored by;
};

/// The best of up to three bounds (weak_duality.h), each after one more correction Y + dY:
///     c_0 - sum_k <B_k0, Y_k> - theta |g_0|,  rounded downward.
std::optional<ShownBound> bound_at(Factored of, const Costs& costs) {
  // Each correction leaves the residuals that double makes of dY; a loss of 1e-15 is rounding.
  constexpr int kCorrections = 3;
  constexpr double kNoLoss = 1e-15;
  const Images images = images_of(of.blocks, std::ssize(costs));
  const auto by = basis_of(images, 1);
  if (!by) return std::nullopt;
  std::optional<ShownBound> best;
  for (int k = 0; k < kCorrections; ++k) {
    const ResidualsInDouble slacks = slacks_of(of, costs);
    const auto move = move_of(*by, slacks);
    if (!move) break;
    const double loss = move->theta * (images.G.col(0).norm() + images.error[0]) * (1 + 1e-12);
    const double low = slacks.r[0] - slacks.error[0] - loss;
    if (std::isfinite(low) && (!best || low > best->value) && leaves_positive(of, move->theta))
      best = ShownBound{low - 4 * kUnitRoundoff * (std::abs(slacks.r[0]) + loss), loss, of};
    if (best && move->theta <= kNoLoss) break;
    correct(*by, move->steps, of);
  }
  return best;
}

}  // namespace

Costs exact_objective(const lmi::Inequalities& of) {
  lmi::Balance units;
  units.unknowns.assign(static_cast<std::size_t>(of.unknowns.size()), 0);
  return ExactBlocks<DoubleDouble>(of, units).objective();
}

Costs on_face(const Faces& faces, const Costs& costs) {
  const numbers::RationalMatrix& N = faces.directions();
  Costs result(static_cast<std::size_t>(N.cols()) + 1);
  result[0] = costs[0];
  for (std::size_t i = 1; i < costs.size(); ++i) {
    if (costs[i].is_zero()) continue;
    result[0] = result[0] + costs[i] * numbers::ball_of(faces.origin()[i - 1]);
    for (std::size_t j = 1; j < result.size(); ++j)
      result[j] = result[j] + costs[i] * numbers::ball_of(N(static_cast<Index>(i) - 1,
                                                            static_cast<Index>(j) - 1));
  }
  return result;
}

std::optional<LowerBound> lower_bound(const BlockList& blocks, const Multipliers& Y, Costs costs) {
  constexpr double kLittle = 1e-11;  // of the bound: 31 digits would show hardly more
  int last = 0;
  for (const auto& block : blocks)
    if (!block.terms.empty()) last = std::max(last, block.terms.back().first);
  if (std::ssize(costs) <= last) costs.resize(static_cast<std::size_t>(last) + 1);
  const auto with = [&](double lift) {
    const auto of = factors_of(blocks, Y, lift);
    return of ? bound_at(*of, costs) : std::nullopt;
  };
  std::optional<ShownBound> best = with(0);
  if (!best || best->loss > kLittle * std::abs(best->value)) {
    // The less is added, the larger is theta, and the better a bound that is shown.
    double before = -std::numeric_limits<double>::infinity();
    for (const double lift : {1e-7, 1e-9, 1e-11, 1e-13, 1e-15}) {
      auto found = with(lift);
      if (!found || found->value <= before) break;
      before = found->value;
      if (!best || found->value > best->value) best = std::move(found);
    }
  }
  if (!best) return std::nullopt;
  LowerBound result{best->value, std::vector<Matrix>(blocks.size())};
  for (std::size_t k = 0; k < best->by.Y.size(); ++k)
    result.Y[static_cast<std::size_t>(best->by.blocks[k].block - blocks.data())] =
        best->by.Y[k].unaryExpr([](const DoubleDouble& x) { return as<double>(x); });
  return result;
}

std::optional<LowerBound> lower_bound(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                                      const lmi::GainBounds& bounds,
                                      const lmi::Formulation& formulation,
                                      const sdp::Solution& solution) {
  constexpr double kMostWork = 6e9;  // multiplications: seconds
  double size = 0;
  for (const int n : formulation.sizes) size += 0.5 * n * (n + 1);
  if (size * std::pow(formulation.variables, 2) > kMostWork || solution.Y.values.empty())
    return std::nullopt;
  const ExactBlocks<DoubleDouble> exact(of, formulation.balance);
  Costs costs = exact.objective();
  for (auto& cost : costs) cost = numbers::scaled(cost, formulation.cost_unit);
  auto bound = lower_bound(blocks_of(of, lmi, bounds, formulation),
                           multipliers_of(formulation, formulation.sizes.size(), solution),
                           std::move(costs));
  if (bound) bound->value /= formulation.cost_unit;
  return bound;
}

}  // namespace gainsmith::verdict
