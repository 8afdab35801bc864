#include "sdp/schur/matrix_schur.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/stop.h"
#include "sdp/core/forecast.h"
#include "sdp/core/work.h"
#include "sdp/schur/kernels.h"

namespace gainsmith::sdp {
namespace {

using Dense = Matrix<double>;

/// The perturbation of the scaled M in units of epsilon, by how much it grows, and how often.
constexpr double kLeastShift = 16, kShiftGrowth = 8;
constexpr int kTries = 12;

}  // namespace

MatrixSchur::MatrixSchur(const MatrixOperator& of) : of_(of) { find_order(); }

std::size_t MatrixSchur::count(std::size_t unknown) const {
  const MatrixProgram::Unknown& V = of_.program().unknowns[unknown];
  return static_cast<std::size_t>(V.symmetric ? V.rows * (V.rows + 1) / 2 : V.rows * V.columns);
}

bool MatrixSchur::is_coupled(std::size_t V, std::size_t U) const {
  return std::ranges::any_of(of_.blocks(), [&](const MatrixOperator::Block& block) {
    return block.terms_of(V) > 0 && block.terms_of(U) > 0;
  });
}

// Those with the fewest neighbours first, counted in variables.
void MatrixSchur::find_order() {
  const std::size_t unknowns = of_.program().unknowns.size();
  std::vector<std::vector<bool>> coupled(unknowns, std::vector<bool>(unknowns));
  std::vector<std::size_t> near(unknowns, 0);
  for (std::size_t V = 0; V < unknowns; ++V)
    for (std::size_t U = 0; U < unknowns; ++U) {
      coupled[V][U] = V == U || is_coupled(V, U);
      if (coupled[V][U]) near[V] += count(U);
    }
  order_.resize(unknowns);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::size_t a, std::size_t b) { return near[a] < near[b]; });
  place_.assign(static_cast<std::size_t>(of_.variables()), 0);
  Eigen::Index next = 0;
  for (const std::size_t unknown : order_)
    for (std::size_t i = 0; i < count(unknown); ++i)
      place_[static_cast<std::size_t>(of_.program().unknowns[unknown].first) + i] = next++;
  for (const int scalar : of_.scalars()) place_[static_cast<std::size_t>(scalar)] = next++;
  estimate(std::move(coupled));
}

// Symbolic elimination in this order: the unknowns that are coupled with one become coupled with
// each other. A step with `own` columns and `later` rows below costs (all^3 - later^3) / 6.
void MatrixSchur::estimate(std::vector<std::vector<bool>> coupled) {
  forming_ = factoring_ = 0;
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t U = order_[k];
    auto later = static_cast<double>(of_.scalars().size());
    for (std::size_t l = k; l < order_.size(); ++l) {
      const std::size_t V = order_[l];
      if (!coupled[U][V]) continue;
      const auto size = static_cast<double>(count(V));
      if (V != U) later += size;
      double common = 0;
      for (const MatrixOperator::Block& block : of_.blocks())
        common += static_cast<double>(block.terms_of(U)) * static_cast<double>(block.terms_of(V));
      // A symmetric one has twice as many elements as scalars, and as many directions.
      const double twice = (of_.program().unknowns[U].symmetric ? 2 : 1) *
                           (of_.program().unknowns[V].symmetric ? 2 : 1);
      forming_ += 2 * twice * common * static_cast<double>(count(U)) * size;
      for (std::size_t m = l; m < order_.size(); ++m)
        if (coupled[U][order_[m]]) coupled[V][order_[m]] = coupled[order_[m]][V] = true;
    }
    const double own = static_cast<double>(count(U)), all = own + later;
    factoring_ += (all * all * all - later * later * later) / 6;
  }
}

/// Of U with each V that comes no earlier.
std::vector<MatrixSchur::Pair> MatrixSchur::pairs(std::size_t U, const Blocks<double>& W) const {
  std::vector<Pair> result;
  for (auto V = std::find(order_.begin(), order_.end(), U); V != order_.end(); ++V)
    result.push_back({*V, U, {}});
  for (std::size_t k = 0; k < of_.blocks().size(); ++k) {
    const std::vector<MatrixOperator::Term>& terms = of_.blocks()[k].terms;
    for (const MatrixOperator::Term& u : terms) {
      if (u.unknown != U) continue;
      const Dense w = W.dense(static_cast<int>(k));
      const Dense WG = u.E.from_left(w), WH = u.F.from_left(w);
      for (Pair& pair : result)
        for (const MatrixOperator::Term& v : terms)
          if (v.unknown == pair.V)
            pair.products.push_back({v.E.transposed_times(WG), v.F.transposed_times(WH),
                                     v.E.transposed_times(WH), v.F.transposed_times(WG)});
    }
  }
  std::erase_if(result, [](const Pair& pair) { return pair.products.empty(); });
  return result;
}

/// column += the part of M (e_c e_d') in V, or of M (e_c e_d' + e_d e_c').
void MatrixSchur::add_image(const Pair& pair, Eigen::Index c, Eigen::Index d,
                            Vector<double>& column) {
  const MatrixProgram::Unknown& V = of_.program().unknowns[pair.V];
  const bool both = of_.program().unknowns[pair.U].symmetric && c != d;
  const auto width = static_cast<Eigen::Index>((both ? 4 : 2) * pair.products.size());
  left_.resize(V.rows, width);
  right_.resize(V.columns, width);
  image_.resize(V.rows, V.columns);
  Eigen::Index at = 0;
  const auto add = [&](const Products& p, Eigen::Index i, Eigen::Index j) {
    left_.col(at) = 2 * p.EG.col(i);
    right_.col(at++) = p.FH.col(j);
    left_.col(at) = 2 * p.EH.col(j);
    right_.col(at++) = p.FG.col(i);
  };
  for (const Products& p : pair.products) {
    add(p, c, d);
    if (both) add(p, d, c);
  }
  multiply_outer(View<const double>(left_), View<const double>(right_), View<double>(image_),
                 Update::assign);
  of_.add_gradient(pair.V, image_, column);
}

/// The columns of the scalars of U, in the rows of the unknowns that come no earlier.
void MatrixSchur::form_columns(std::size_t U, const std::vector<Pair>& pairs) {
  const MatrixProgram::Unknown& of = of_.program().unknowns[U];
  Eigen::Index column = place_[static_cast<std::size_t>(of.first)];
  Vector<double> image(of_.variables());
  for (Eigen::Index d = 0; d < of.columns; ++d) {
    check_stop();
    for (Eigen::Index c = of.symmetric ? d : 0; c < of.rows; ++c, ++column) {
      image.setZero();
      for (const Pair& pair : pairs) {
        add_image(pair, c, d, image);
        const Eigen::Index first = of_.program().unknowns[pair.V].first;
        const auto size = static_cast<Eigen::Index>(count(pair.V));
        factor_.col(column).segment(place_[static_cast<std::size_t>(first)], size) =
            image.segment(first, size);
      }
    }
  }
}

/// The row of a scalar is M applied to its unit vector.
void MatrixSchur::add_scalars(const SchurOperator& M) {
  Vector<double> unit = Vector<double>::Zero(of_.variables()), image;
  for (const int scalar : of_.scalars()) {
    check_stop();
    unit[scalar] = 1;
    M.apply(unit, image);
    unit[scalar] = 0;
    const Eigen::Index row = place_[static_cast<std::size_t>(scalar)];
    for (std::size_t i = 0; i < place_.size(); ++i)
      if (place_[i] <= row) factor_(row, place_[i]) = image[static_cast<Eigen::Index>(i)];
  }
}

/// Of variables in matrices alone: the scalars have theirs.
void MatrixSchur::add_rows(const Blocks<double>& W) {
  const auto scalars = static_cast<Eigen::Index>(of_.scalars().size());
  for (std::size_t r = 0; r < of_.rows().size(); ++r) {
    const Vector<double>& a = of_.rows()[r].coefficients;
    std::vector<std::size_t> present;
    for (std::size_t i = 0; i < place_.size(); ++i)
      if (a[static_cast<Eigen::Index>(i)] != 0 && place_[i] < of_.variables() - scalars)
        present.push_back(i);
    const double weight = W.linear()[static_cast<Eigen::Index>(r)];
    for (const std::size_t i : present)
      for (const std::size_t j : present)
        if (place_[i] >= place_[j])
          factor_(place_[i], place_[j]) +=
              weight * a[static_cast<Eigen::Index>(i)] * a[static_cast<Eigen::Index>(j)];
  }
}

void MatrixSchur::form(const SchurOperator& M, const Blocks<double>& W) {
  factor_.setZero();
  for (const std::size_t U : order_) form_columns(U, pairs(U, W));
  add_scalars(M);
  add_rows(W);
  spend_on<double>(forming_);
}

bool MatrixSchur::prepare(const SchurOperator& M, const Blocks<double>& W) {
  const Eigen::Index m = of_.variables();
  if (factor_.size() == 0) {
    require_memory(static_cast<int>(m), static_cast<double>(m * m) * sizeof(double));
    factor_.resize(m, m);
  }
  // M is formed again for each attempt, as its factor takes its place.
  double delta = kLeastShift * std::numeric_limits<double>::epsilon();
  for (int attempt = 0; attempt < kTries; ++attempt, delta *= kShiftGrowth) {
    form(M, W);
    scale_ = factor_.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1; });
    for (Eigen::Index j = 0; j < m; ++j)
      factor_.col(j).tail(m - j).array() *= scale_[j] * scale_.tail(m - j).array();
    factor_.diagonal().setConstant(1 + delta);
    if (cholesky(View<double>(factor_))) return true;
  }
  return false;
}

void MatrixSchur::apply(const Vector<double>& r, Vector<double>& z) const {
  Vector<double> ordered(r.size());
  for (std::size_t i = 0; i < place_.size(); ++i)
    ordered[place_[i]] = r[static_cast<Eigen::Index>(i)];
  ordered.array() *= scale_.array();
  solve_factored(View<const double>(factor_), ordered);
  ordered.array() *= scale_.array();
  z.resize(r.size());
  for (std::size_t i = 0; i < place_.size(); ++i)
    z[static_cast<Eigen::Index>(i)] = ordered[place_[i]];
}

}  // namespace gainsmith::sdp
