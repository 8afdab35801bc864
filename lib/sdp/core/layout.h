// Where the numbers of a block-diagonal matrix live in one contiguous buffer.
#pragma once

#include <cstddef>
#include <vector>

namespace gainsmith::sdp {

/// The cone of the working problem: dense blocks S^{n_1} x ... x S^{n_k} and one nonnegative
/// orthant R^l that gathers every diagonal entry. Packing: dense block b is n_b x n_b column-major,
/// both triangles stored, at offset[b]; the l linear entries follow at linear_offset.
struct Layout {
  std::vector<int> size;            ///< n_b
  std::vector<std::size_t> offset;  ///< of dense block b
  int linear = 0;                   ///< l
  std::size_t linear_offset = 0;
  std::size_t total = 0;  ///< numbers in the buffer

  Layout() = default;
  Layout(std::vector<int> sizes, int linear_entries)
      : size(std::move(sizes)), linear(linear_entries) {
    for (const int n : size) {
      offset.push_back(total);
      total += static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
    }
    linear_offset = total;
    total += static_cast<std::size_t>(linear);
  }

  int blocks() const { return static_cast<int>(size.size()); }

  /// n = sum n_b + l, the barrier parameter of the cone.
  int order() const {
    int sum = linear;
    for (const int n : size) sum += n;
    return sum;
  }
};

}  // namespace gainsmith::sdp
