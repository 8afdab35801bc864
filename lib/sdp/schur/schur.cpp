#include "sdp/schur/schur.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <type_traits>

#include "base/parallel.h"
#include "base/scalars.h"
#include "base/stop.h"
#include "sdp/core/forecast.h"
#include "sdp/core/work.h"
#include "sdp/schur/cover.h"
#include "sdp/schur/kernels.h"

namespace gainsmith::sdp {
namespace {

/// The place of (row, column), row <= column, in an upper triangle packed by columns.
std::size_t packed_index(int row, int column) {
  return static_cast<std::size_t>(column) * (static_cast<std::size_t>(column) + 1) / 2 +
         static_cast<std::size_t>(row);
}

template <typename T>
T dot(const T* a, const T* b, Eigen::Index count) {
  if constexpr (std::is_same_v<T, DoubleDouble>) {
    return inner_product(a, b, static_cast<std::size_t>(count));
  } else {
    T sum(0);
    for (Eigen::Index k = 0; k < count; ++k) sum += a[k] * b[k];
    return sum;
  }
}

/// Relative costs of one multiplication in a matrix product, in the panel's interleaved inner
/// products, and in a dot product with gathered ends; measured on AVX-512.
constexpr double kProductCost = 0.06;
constexpr double kPanelCost = 0.2;
constexpr double kDotCost = 1.0;
/// What a product by rank costs beside its multiplications, in units of inner length.
constexpr double kRankRest = 8;
/// A block cheaper than this is not worth starting threads for.
constexpr double kParallelCost = 1e6;
/// The perturbation of a B that has no Cholesky factor: eps times this, growing by it, so often.
constexpr double kGrowth = 8;
constexpr int kAttempts = 20;
/// The least perturbation in double, in units of epsilon: less than the errors of the assembly, and
/// enough to keep a pivot of a nearly singular B from being one of them.
constexpr double kLeastUnits = 16;

}  // namespace

template <typename T>
Schur<T>::Schur(const Data& data, unsigned threads)
    : data_(data),
      threads_(thread_count(threads)),
      columns_(static_cast<std::size_t>(data.layout.linear)),
      sparse_(data) {
  const int m = data.m();
  for (int b = 0; b < data.layout.blocks(); ++b) {
    const int n = data.layout.size[static_cast<std::size_t>(b)];
    plans_.push_back(plan_block(data.dense[static_cast<std::size_t>(b)], n));
  }
  size_workspaces();
  const BlockData& linear = data.linear;
  for (int k = 0; k < linear.lists(); ++k) {
    const auto list = static_cast<std::size_t>(k);
    if (linear.constraint[list] == 0) continue;
    for (std::size_t t = linear.start[list]; t < linear.start[list + 1]; ++t)
      columns_[static_cast<std::size_t>(linear.terms[t].row)].emplace_back(
          linear.constraint[list] - 1, coefficient<T>(linear, t));
  }
  if (!sparse_.worthwhile()) {
    require_memory(m, bytes_of_iterates<T>(data) + bytes_of_dense_schur<T>(m));
    // The system gives their memory page by page, which takes its time.
    for (Matrix<T>* both : {&b_, &factor_}) {
      both->resize(m, m);
      for (Eigen::Index j = 0; j < m; ++j) {
        check_stop();
        both->col(j).setZero();
      }
    }
  }
  scale_.setZero(m);
}

// Lists of many entries come first: the product U of one serves all that follow. Runs of one
// formula become batches of kBatch lists, but by rows each list is its own.
template <typename T>
typename Schur<T>::Plan Schur<T>::plan_block(const BlockData& block, int n) const {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < block.constraint.size(); ++k)
    if (block.constraint[k] != 0) order.push_back(k);
  const auto nonzeros = [&](std::size_t k) { return block.start[k + 1] - block.start[k]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return nonzeros(a) > nonzeros(b); });
  Plan plan;
  double following = 0;
  for (const std::size_t k : order) following += static_cast<double>(nonzeros(k));
  for (const std::size_t k : order) {
    append_list(block, k, plan);
    choose_formula(plan, following, n);
    following -= static_cast<double>(nonzeros(k));
  }
  for (std::size_t first = 0; first < plan.lists.size();) {
    std::size_t last = first + 1;
    const Formula formula = plan.lists[first].formula;
    while (formula != Formula::rows && last < plan.lists.size() && last < first + kBatch &&
           plan.lists[last].formula == formula)
      ++last;
    plan.batches.push_back({first, last});
    first = last;
  }
  return plan;
}

template <typename T>
void Schur<T>::append_list(const BlockData& block, std::size_t k, Plan& plan) const {
  List& list = plan.lists.emplace_back();
  list.constraint = block.constraint[k] - 1;
  list.first = plan.terms.size();
  for (std::size_t t = block.start[k]; t < block.start[k + 1]; ++t) {
    const Term& term = block.terms[t];
    plan.terms.push_back(term);
    plan.value.push_back(coefficient<T>(block, t));
    plan.packed.push_back(static_cast<int>(packed_index(term.row, term.column)));
  }
  list.last = plan.terms.size();
}

// Costs, with f the terms of the lists that follow, s the rows of the cover and r the nonzero rows:
//   dense  kProductCost n^3 + kPanelCost f
//   rank   kProductCost n (n (2 s + kRankRest) + 2 nonzeros) + kPanelCost f
//   rows   2 kDotCost r f + kPanelCost r n
template <typename T>
void Schur<T>::choose_formula(Plan& plan, double following, int n) const {
  List& list = plan.lists.back();
  const Term* const first = plan.terms.data() + list.first;
  const Term* const last = plan.terms.data() + list.last;
  const auto nonzeros = static_cast<double>(last - first);
  const double size = n, products = kPanelCost * following;
  double cost = kProductCost * size * size * size + products;

  Cover cover = cover_of(first, last, n);
  cover.slot.resize(list.last - list.first);
  plan.slot.insert(plan.slot.end(), cover.slot.begin(), cover.slot.end());
  const double inner = 2.0 * static_cast<double>(cover.rows.size()) + kRankRest;
  const double by_rank = kProductCost * size * (size * inner + 2.0 * nonzeros) + products;
  if (cover.found && by_rank < cost) {
    list.formula = Formula::rank;
    list.rows = std::move(cover.rows);
    cost = by_rank;
  }
  std::set<int> rows;
  for (const Term* term = first; term != last; ++term) {
    rows.insert(term->row);
    rows.insert(term->column);
  }
  const auto r = static_cast<double>(rows.size());
  const double by_rows = kDotCost * 2 * r * following + kPanelCost * r * size;
  if (by_rows < cost) {
    list.formula = Formula::rows;
    list.rows.assign(rows.begin(), rows.end());
    cost = by_rows;
  }
  plan.cost += cost;
}

// The largest that any list of any block needs, once for each thread.
template <typename T>
void Schur<T>::size_workspaces() {
  std::size_t product = 0, panel = 0, rank_rows = 0, rank = 0;
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    const auto n = static_cast<std::size_t>(data_.layout.size[b]);
    for (const List& list : plans_[b].lists) {
      const bool by_rows = list.formula == Formula::rows;
      product = std::max(product, n * (by_rows ? list.rows.size() : n * kBatch));
      if (!by_rows) panel = std::max(panel, n * (n + 1) / 2);
      if (list.formula != Formula::rank) continue;
      rank_rows = std::max(rank_rows, n);
      rank = std::max(rank, 2 * list.rows.size());
    }
  }
  work_.resize(threads_);
  for (Workspace& w : work_) {
    w.h.resize(static_cast<Eigen::Index>(product));
    w.u.resize(static_cast<Eigen::Index>(product));
    w.panel.resize(panel);
    w.p.resize(static_cast<Eigen::Index>(rank_rows), static_cast<Eigen::Index>(rank));
    w.q = w.p;
  }
}

template <typename T>
void Schur<T>::assemble(const Blocks<T>& inverse_X, const Blocks<T>& Y) {
  if (sparse_.worthwhile())
    sparse_.set_zero();
  else
    b_.setZero();
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    const Plan& plan = plans_[b];
    const auto block_X = inverse_X.dense(static_cast<int>(b));
    const auto block_Y = Y.dense(static_cast<int>(b));
    const auto share = [&](std::size_t first, std::size_t step) {
      for (std::size_t k = first; k < plan.batches.size(); k += step) {
        check_stop();
        add_batch(plan, plan.batches[k], block_X, block_Y, work_[first]);
      }
    };
    // Within a block every entry of B belongs to one batch, so the split cannot change a bit of it.
    if (threads_ > 1 && plan.cost > kParallelCost)
      parallel_for(threads_, threads_, [&](std::size_t t) { share(t, threads_); });
    else
      share(0, 1);
  }
  add_linear(inverse_X.linear(), Y.linear());
}

template <typename T>
void Schur<T>::add_batch(const Plan& plan, const Batch& batch, const ConstMatrixMap<T>& inverse_X,
                         const ConstMatrixMap<T>& Y, Workspace& w) {
  spend_on<T>(plan.cost / static_cast<double>(plan.batches.size()));
  if (plan.lists[batch.first].formula == Formula::rows)
    add_rows(plan, batch.first, inverse_X, Y, w);
  else
    add_dense(plan, batch.first, batch.last, inverse_X, Y, w);
}

// h, transposed and stacked: row b + n i, column c holds (F_i Y)(c, b), so that one product gives
//   u = h X^-1:  row b + n i, column a holds U_i(a, b).
template <typename T>
void Schur<T>::multiply_lists(const Plan& plan, std::size_t first, std::size_t last,
                              const ConstMatrixMap<T>& inverse_X, const ConstMatrixMap<T>& Y,
                              Workspace& w) const {
  const Eigen::Index n = Y.rows();
  const auto count = static_cast<Eigen::Index>(last - first);
  MatrixMap<T> u(w.u.data(), n * count, n);
  if (plan.lists[first].formula == Formula::rank) {
    for (Eigen::Index i = 0; i < count; ++i)
      multiply_by_rank(plan, plan.lists[first + static_cast<std::size_t>(i)], inverse_X, Y, w,
                       View<T>(u).part(n * i, 0, n, n));
    return;
  }
  MatrixMap<T> h(w.h.data(), n * count, n);
  h.setZero();
  for (Eigen::Index i = 0; i < count; ++i) {
    const List& list = plan.lists[first + static_cast<std::size_t>(i)];
    for (std::size_t t = list.first; t < list.last; ++t) {
      const Term& term = plan.terms[t];
      h.col(term.row).segment(n * i, n) += Y.col(term.column) * plan.value[t];
      if (term.row != term.column)
        h.col(term.column).segment(n * i, n) += Y.col(term.row) * plan.value[t];
    }
  }
  multiply(View<const T>(h), View<const T>(inverse_X), View<T>(u));
}

// P = [X^-1 e_s, X^-1 g_s], Q = [Y g_s, Y e_s]; the diagonal entries of F_i are halved in g_s.
template <typename T>
void Schur<T>::multiply_by_rank(const Plan& plan, const List& list,
                                const ConstMatrixMap<T>& inverse_X, const ConstMatrixMap<T>& Y,
                                Workspace& w, const View<T>& u) const {
  const Eigen::Index n = Y.rows();
  const auto r = static_cast<Eigen::Index>(list.rows.size());
  MatrixMap<T> p(w.p.data(), n, 2 * r), q(w.q.data(), n, 2 * r);
  for (Eigen::Index k = 0; k < r; ++k) {
    const int s = list.rows[static_cast<std::size_t>(k)];
    p.col(k) = inverse_X.col(s);
    q.col(r + k) = Y.col(s);
  }
  p.rightCols(r).setZero();
  q.leftCols(r).setZero();
  for (std::size_t t = list.first; t < list.last; ++t) {
    const Term& term = plan.terms[t];
    const int k = plan.slot[t];
    const int other = list.rows[static_cast<std::size_t>(k)] == term.row ? term.column : term.row;
    const T factor = term.row == term.column ? T(T(0.5) * plan.value[t]) : plan.value[t];
    p.col(r + k) += inverse_X.col(other) * factor;
    q.col(k) += Y.col(other) * factor;
  }
  multiply_outer(View<const T>(q), View<const T>(p), u);
}

// The panel at (a, b), a <= b, holds U_i(a, b) + U_i(b, a) (once when a = b) for the batch's i.
template <typename T>
void Schur<T>::add_dense(const Plan& plan, std::size_t first, std::size_t last,
                         const ConstMatrixMap<T>& inverse_X, const ConstMatrixMap<T>& Y,
                         Workspace& w) {
  multiply_lists(plan, first, last, inverse_X, Y, w);
  const Eigen::Index n = Y.rows();
  const auto count = static_cast<Eigen::Index>(last - first);
  const ConstMatrixMap<T> u(w.u.data(), n * count, n);
  std::size_t entry = 0;
  for (Eigen::Index b = 0; b < n; ++b)
    for (Eigen::Index a = 0; a <= b; ++a, ++entry)
      for (Eigen::Index i = 0; i < kBatch; ++i) {
        T value(0);
        if (i < count) value = a == b ? u(a + n * i, a) : T(u(b + n * i, a) + u(a + n * i, b));
        w.panel.set(entry, static_cast<std::size_t>(i), value);
      }

  for (std::size_t q = first; q < plan.lists.size(); ++q) {
    const List& other = plan.lists[q];
    const auto sums = w.panel.inner(plan.packed.data() + other.first,
                                    plan.value.data() + other.first, other.last - other.first);
    const std::size_t pairs = std::min(q + 1, last) - first;
    for (std::size_t i = 0; i < pairs; ++i)
      add(plan.lists[first + i].constraint, other.constraint, sums[i]);
  }
}

// h is |R| x n with (F_i Y)(c, :), u is |R| x n with X^-1(c, :), c in R.
template <typename T>
void Schur<T>::add_rows(const Plan& plan, std::size_t position, const ConstMatrixMap<T>& inverse_X,
                        const ConstMatrixMap<T>& Y, Workspace& w) {
  const List& list = plan.lists[position];
  const Eigen::Index n = Y.rows();
  const auto r = static_cast<Eigen::Index>(list.rows.size());
  MatrixMap<T> h(w.h.data(), r, n);
  MatrixMap<T> u(w.u.data(), r, n);
  h.setZero();
  const auto place = [&](int row) {
    return std::lower_bound(list.rows.begin(), list.rows.end(), row) - list.rows.begin();
  };
  for (std::size_t t = list.first; t < list.last; ++t) {
    const Term& term = plan.terms[t];
    h.row(place(term.row)) += Y.col(term.column).transpose() * plan.value[t];
    if (term.row != term.column)
      h.row(place(term.column)) += Y.col(term.row).transpose() * plan.value[t];
  }
  for (Eigen::Index k = 0; k < r; ++k)
    u.row(k) = inverse_X.col(list.rows[static_cast<std::size_t>(k)]).transpose();

  for (std::size_t q = position; q < plan.lists.size(); ++q) {
    const List& other = plan.lists[q];
    T sum(0);
    for (std::size_t t = other.first; t < other.last; ++t) {
      const Term& term = plan.terms[t];
      T entry = dot(u.data() + r * term.row, h.data() + r * term.column, r);
      if (term.row != term.column)
        entry += dot(u.data() + r * term.column, h.data() + r * term.row, r);
      sum += entry * plan.value[t];
    }
    add(list.constraint, other.constraint, sum);
  }
}

// B_ij += sum_k F_i[k] F_j[k] y_k / x_k over the entries k of the linear part.
template <typename T>
void Schur<T>::add_linear(const ConstVectorMap<T>& inverse_x, const ConstVectorMap<T>& y) {
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const T weight = inverse_x[at] * y[at];
    const auto& column = columns_[k];
    for (std::size_t p = 0; p < column.size(); ++p) {
      const T scaled = weight * column[p].second;
      for (std::size_t q = 0; q <= p; ++q)
        add(column[p].first, column[q].first, scaled * column[q].second);
    }
  }
}

template <typename T>
bool Schur<T>::factorise() {
  using std::sqrt;
  for (int i = 0; i < data_.m(); ++i) {
    const T diagonal = sparse_.worthwhile() ? sparse_.diagonal(i) : b_(i, i);
    scale_[i] = diagonal > T(0) ? T(T(1) / sqrt(diagonal)) : T(1);
  }
  T delta(std::is_same_v<T, double> ? kLeastUnits * std::numeric_limits<double>::epsilon() : 0.0);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (factorise(delta)) return true;
    delta = T(kGrowth) * (delta == T(0) ? T(std::numeric_limits<T>::epsilon()) : delta);
  }
  return false;
}

template <typename T>
bool Schur<T>::factorise(const T& delta) {
  if (sparse_.worthwhile()) return sparse_.factorise(scale_, delta);
  const Eigen::Index m = b_.rows();
  for (Eigen::Index j = 0; j < m; ++j)
    factor_.col(j).tail(m - j) = scale_[j] * b_.col(j).tail(m - j).cwiseProduct(scale_.tail(m - j));
  factor_.diagonal().setConstant(T(1) + delta);
  return cholesky(View<T>(factor_));
}

// x = D (D B D + delta I)^-1 D r with D = diag(B)^-1/2, the inverse by the factor.
template <typename T>
void Schur<T>::solve(const Vector<T>& r, Vector<T>& x) const {
  x = r.cwiseProduct(scale_);
  if (sparse_.worthwhile())
    sparse_.solve(x);
  else
    solve_factored(View<const T>(factor_), x);
  x = x.cwiseProduct(scale_);
}

#define GAINSMITH_INSTANTIATE(T) template class Schur<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
