#include "sdp/schur/sparse_schur.h"

#include <algorithm>

#include "base/scalars.h"

namespace gainsmith::sdp {
namespace {

/// Smaller systems, and those with a larger part of the lower triangle in use, are factored
/// densely.
constexpr int kSmallest = 100;
constexpr double kDensest = 0.2;

/// The F_i that share an entry of the cone's block or of its linear part, i from 0 and increasing.
std::vector<std::vector<int>> groups(const Data& data) {
  std::vector<std::vector<int>> result;
  for (const BlockData& block : data.dense) {
    auto& group = result.emplace_back();
    for (const int constraint : block.constraint)
      if (constraint > 0) group.push_back(constraint - 1);
  }
  const std::size_t linear = result.size();
  result.resize(linear + static_cast<std::size_t>(data.layout.linear));
  for (int k = 0; k < data.linear.lists(); ++k) {
    const auto list = static_cast<std::size_t>(k);
    if (data.linear.constraint[list] == 0) continue;
    for (std::size_t t = data.linear.start[list]; t < data.linear.start[list + 1]; ++t)
      result[linear + static_cast<std::size_t>(data.linear.terms[t].row)].push_back(
          data.linear.constraint[list] - 1);
  }
  return result;
}

}  // namespace

// Column by column the i >= j that share a group with j. Gives up where a group, or all columns,
// have more entries than kDensest of the triangle.
template <typename T>
SparseSchur<T>::SparseSchur(const Data& data) {
  const int m = data.m();
  if (m < kSmallest) return;
  const auto together = groups(data);
  const double limit = kDensest * m * m / 2;
  std::vector<std::vector<std::size_t>> member(static_cast<std::size_t>(m));
  for (std::size_t g = 0; g < together.size(); ++g) {
    const auto size = static_cast<double>(together[g].size());
    if (size * size / 2 > limit) return;
    for (const int i : together[g]) member[static_cast<std::size_t>(i)].push_back(g);
  }
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(m));
  std::vector<int> last_seen(static_cast<std::size_t>(m), -1);
  double count = 0;
  for (int j = 0; j < m; ++j) {
    auto& column = columns[static_cast<std::size_t>(j)];
    column.push_back(j);
    for (const std::size_t g : member[static_cast<std::size_t>(j)])
      for (const int i : together[g])
        if (i > j && last_seen[static_cast<std::size_t>(i)] != j) {
          last_seen[static_cast<std::size_t>(i)] = j;
          column.push_back(i);
        }
    std::sort(column.begin(), column.end());
    count += static_cast<double>(column.size());
    if (count > limit) return;
  }
  build(columns);
}

template <typename T>
void SparseSchur<T>::build(const std::vector<std::vector<int>>& columns) {
  const auto m = static_cast<Eigen::Index>(columns.size());
  std::vector<Eigen::Triplet<T>> places;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (const int i : columns[j]) places.emplace_back(i, static_cast<int>(j), T(1));
  b_.resize(m, m);
  b_.setFromTriplets(places.begin(), places.end());
  scaled_ = b_;
  llt_.analyzePattern(b_);
  worthwhile_ = true;
}

template <typename T>
void SparseSchur<T>::set_zero() {
  std::fill_n(b_.valuePtr(), b_.nonZeros(), T(0));
}

template <typename T>
void SparseSchur<T>::add(int i, int j, const T& value) {
  const auto* const first = b_.innerIndexPtr() + b_.outerIndexPtr()[j];
  const auto* const last = b_.innerIndexPtr() + b_.outerIndexPtr()[j + 1];
  b_.valuePtr()[std::lower_bound(first, last, i) - b_.innerIndexPtr()] += value;
}

template <typename T>
bool SparseSchur<T>::factorise(const Vector<T>& scale, const T& delta) {
  for (Eigen::Index j = 0; j < b_.cols(); ++j)
    for (auto p = b_.outerIndexPtr()[j]; p < b_.outerIndexPtr()[j + 1]; ++p) {
      const auto i = b_.innerIndexPtr()[p];
      scaled_.valuePtr()[p] = i == j ? T(T(1) + delta) : T(b_.valuePtr()[p] * scale[i] * scale[j]);
    }
  llt_.factorize(scaled_);
  return llt_.info() == Eigen::Success;
}

#define GAINSMITH_INSTANTIATE(T) template class SparseSchur<T>;
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
