// The dense types and block-diagonal arithmetic that the solver is written in. Internal: Eigen does
// not appear in the room's public headers.
#pragma once

#include <Eigen/Core>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "sdp/core/layout.h"

namespace gainsmith::sdp {

template <typename T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <typename T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
template <typename T>
using MatrixMap = Eigen::Map<Matrix<T>>;
template <typename T>
using ConstMatrixMap = Eigen::Map<const Matrix<T>>;
template <typename T>
using VectorMap = Eigen::Map<Vector<T>>;
template <typename T>
using ConstVectorMap = Eigen::Map<const Vector<T>>;

/// A symmetric block-diagonal matrix in the packing of `Layout`. The layout must outlive it.
template <typename T>
class Blocks {
 public:
  explicit Blocks(const Layout& layout)
      : layout_(&layout), values_(static_cast<Eigen::Index>(layout.total)) {
    values_.setZero();
  }

  const Layout& layout() const { return *layout_; }
  /// All numbers in the packing of the layout, Layout::total of them.
  Vector<T>& flat() { return values_; }
  const Vector<T>& flat() const { return values_; }

  /// Dense block b as an n_b x n_b map. Both triangles are stored and have to agree.
  MatrixMap<T> dense(int b) {
    const auto i = static_cast<std::size_t>(b);
    return {values_.data() + layout_->offset[i], layout_->size[i], layout_->size[i]};
  }
  ConstMatrixMap<T> dense(int b) const {
    const auto i = static_cast<std::size_t>(b);
    return {values_.data() + layout_->offset[i], layout_->size[i], layout_->size[i]};
  }
  /// The l entries of the linear part.
  VectorMap<T> linear() { return {values_.data() + layout_->linear_offset, layout_->linear}; }
  ConstVectorMap<T> linear() const {
    return {values_.data() + layout_->linear_offset, layout_->linear};
  }

  /// value * I.
  void set_identity(const T& value) {
    values_.setZero();
    for (int b = 0; b < layout_->blocks(); ++b) dense(b).diagonal().setConstant(value);
    linear().setConstant(value);
  }

 private:
  const Layout* layout_;
  Vector<T> values_;
};

/// Rounds (or widens) every number of `from`; nothing to do but copy when the types are the same.
template <typename To, typename From>
void convert(const Vector<From>& from, Vector<To>& to) {
  for (Eigen::Index i = 0; i < from.size(); ++i) to[i] = as<To>(from[i]);
}

/// A . B = trace(A B); both triangles are stored, so it is the product of the packed numbers.
template <typename T>
T inner(const Blocks<T>& a, const Blocks<T>& b) {
  return a.flat().dot(b.flat());
}

}  // namespace gainsmith::sdp
