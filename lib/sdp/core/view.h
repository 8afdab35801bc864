// Matrices that live elsewhere, for the kernels.
#pragma once

#include <Eigen/Core>

namespace gainsmith::sdp {

/// A column-major matrix that lives elsewhere.
template <typename T>
struct View {
  T* data = nullptr;
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  Eigen::Index stride = 0;  ///< numbers from one column to the next

  View(T* values, Eigen::Index r, Eigen::Index c, Eigen::Index s)
      : data(values), rows(r), columns(c), stride(s) {}
  template <typename Map>
  explicit View(Map&& map) : View(map.data(), map.rows(), map.cols(), map.outerStride()) {}

  T& operator()(Eigen::Index i, Eigen::Index j) const { return data[i + stride * j]; }
  /// The r x c numbers from (i, j) on, in place.
  View part(Eigen::Index i, Eigen::Index j, Eigen::Index r, Eigen::Index c) const {
    return {data + i + stride * j, r, c, stride};
  }
};

/// The same numbers, read only.
template <typename T>
View<const T> constant(const View<T>& v) {
  return {v.data, v.rows, v.columns, v.stride};
}

/// C = A B, or C -= A B.
enum class Update { assign, subtract };

}  // namespace gainsmith::sdp
