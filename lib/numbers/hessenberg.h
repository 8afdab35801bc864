// Internal to numbers: eigenvalues of a real matrix by Francis' double shifts on its Hessenberg
// form (Wilkinson & Reinsch, Handbook for Automatic Computation II, elmhes and hqr).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/stop.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

template <class W>
struct Eigenvalue {
  W real{0};
  W imaginary{0};
};

template <class W>
class Hessenberg {
 public:
  using Index = Eigen::Index;

  explicit Hessenberg(MatrixOf<W> M) : A_(std::move(M)), shifted_(0) {
    reduce();
    norm_ = W(0);
    for (Index i = 0; i < A_.rows(); ++i)
      for (Index j = std::max<Index>(i - 1, 0); j < A_.cols(); ++j) norm_ += size(A_(i, j));
  }

  /// In no order; none where one is not found.
  std::optional<std::vector<Eigenvalue<W>>> eigenvalues() {
    constexpr int kMostSteps = 300;
    Index last = A_.rows() - 1;
    int step = 0;
    while (last >= 0) {
      check_stop();
      const Index first = start_of_block(last);
      if (first == last) {
        found_.push_back({W(A_(last, last) + shifted_), W(0)});
        last -= 1;
        step = 0;
      } else if (first + 1 == last) {
        pair(last);
        last -= 2;
        step = 0;
      } else {
        if (step == kMostSteps) return std::nullopt;
        sweep(first, last, shift(last, step));
        ++step;
      }
    }
    return found_;
  }

 private:
  /// The sum and the product of two shifts are x + y and x y - w.
  struct Shift {
    W x, y, w;
  };
  struct Reflection {
    W p, q, r;
  };

  static W size(const W& x) { return x < W(0) ? W(-x) : x; }
  static constexpr int kExceptional = 10;

  /// By elimination with pivots; similar to A.
  void reduce() {
    const Index n = A_.rows();
    for (Index m = 1; m + 1 < n; ++m) {
      Index pivot = m;
      for (Index i = m; i < n; ++i)
        if (size(A_(i, m - 1)) > size(A_(pivot, m - 1))) pivot = i;
      const W by = A_(pivot, m - 1);
      if (by == W(0)) continue;
      if (pivot != m) {
        for (Index j = m - 1; j < n; ++j) std::swap(A_(pivot, j), A_(m, j));
        for (Index i = 0; i < n; ++i) std::swap(A_(i, pivot), A_(i, m));
      }
      for (Index i = m + 1; i < n; ++i) {
        const W factor = A_(i, m - 1) / by;
        if (factor == W(0)) continue;
        A_(i, m - 1) = W(0);
        for (Index j = m; j < n; ++j) A_(i, j) -= factor * A_(m, j);
        for (Index k = 0; k < n; ++k) A_(k, m) += factor * A_(k, i);
      }
    }
  }

  /// Where an element below the diagonal is nothing beside its neighbours it becomes 0.
  Index start_of_block(Index last) {
    for (Index k = last; k >= 1; --k) {
      W beside = size(A_(k - 1, k - 1)) + size(A_(k, k));
      if (beside == W(0)) beside = norm_;
      if (size(A_(k, k - 1)) > std::numeric_limits<W>::epsilon() * beside) continue;
      A_(k, k - 1) = W(0);
      return k;
    }
    return 0;
  }

  /// The two eigenvalues of the block of two that ends at `last`.
  void pair(Index last) {
    using std::sqrt;
    const W x = A_(last, last), y = A_(last - 1, last - 1);
    const W w = A_(last, last - 1) * A_(last - 1, last);
    const W p = (y - x) / W(2);
    const W q = p * p + w;
    const W root = sqrt(size(q));
    const W middle = x + shifted_;
    if (q < W(0)) {
      found_.push_back({W(middle + p), root});
      found_.push_back({W(middle + p), W(-root)});
      return;
    }
    const W z = p < W(0) ? W(p - root) : W(p + root);
    found_.push_back({W(middle + z), W(0)});
    found_.push_back({z == W(0) ? middle : W(middle - w / z), W(0)});
  }

  Shift shift(Index last, int step) {
    if (step > 0 && step % kExceptional == 0) {
      const W x = A_(last, last);
      shifted_ += x;
      for (Index i = 0; i <= last; ++i) A_(i, i) -= x;
      const W s = size(A_(last, last - 1)) + size(A_(last - 1, last - 2));
      return {W(s * W(0.75)), W(s * W(0.75)), W(s * s * W(-0.4375))};
    }
    return {A_(last, last), A_(last - 1, last - 1), W(A_(last, last - 1) * A_(last - 1, last))};
  }

  /// The first column of (A - s)(A - t) from row m on, to a factor.
  Reflection begun(Index m, const Shift& by) const {
    const W z = A_(m, m);
    const W r = by.x - z, s = by.y - z;
    Reflection v{W((r * s - by.w) / A_(m + 1, m) + A_(m, m + 1)), W(A_(m + 1, m + 1) - z - r - s),
                 A_(m + 2, m + 1)};
    return scaled(v, W(size(v.p) + size(v.q) + size(v.r)));
  }
  static Reflection scaled(const Reflection& v, const W& by) {
    if (by == W(0)) return v;
    return {W(v.p / by), W(v.q / by), W(v.r / by)};
  }

  void sweep(Index first, Index last, const Shift& by) {
    Index m = last - 2;
    Reflection v = begun(m, by);
    for (; m > first; v = begun(--m, by)) {
      const W left = size(A_(m, m - 1)) * (size(v.q) + size(v.r));
      const W right =
          size(v.p) * (size(A_(m - 1, m - 1)) + size(A_(m, m)) + size(A_(m + 1, m + 1)));
      if (left <= std::numeric_limits<W>::epsilon() * right) break;
    }
    for (Index i = m + 2; i <= last; ++i) {
      A_(i, i - 2) = W(0);
      if (i != m + 2) A_(i, i - 3) = W(0);
    }
    for (Index k = m; k < last; ++k) chase(first, last, m, k, v);
  }

  /// One reflection of rows and columns k, k + 1, k + 2.
  void chase(Index first, Index last, Index m, Index k, Reflection v) {
    using std::sqrt;
    const bool three = k + 1 != last;
    W scale(1);
    if (k != m) {
      v = {A_(k, k - 1), A_(k + 1, k - 1), three ? A_(k + 2, k - 1) : W(0)};
      scale = size(v.p) + size(v.q) + size(v.r);
      if (scale == W(0)) return;
      v = scaled(v, scale);
    }
    W s = sqrt(W(v.p * v.p + v.q * v.q + v.r * v.r));
    if (v.p < W(0)) s = -s;
    if (s == W(0)) return;
    if (k != m) {
      A_(k, k - 1) = -s * scale;
    } else if (first != m) {
      A_(k, k - 1) = -A_(k, k - 1);
    }
    const W p = v.p + s;
    const W x = p / s, y = v.q / s, z = v.r / s, q = v.q / p, r = v.r / p;
    for (Index j = k; j <= last; ++j) {
      const W along = A_(k, j) + q * A_(k + 1, j) + (three ? W(r * A_(k + 2, j)) : W(0));
      A_(k, j) -= along * x;
      A_(k + 1, j) -= along * y;
      if (three) A_(k + 2, j) -= along * z;
    }
    for (Index i = first; i <= std::min(last, k + 3); ++i) {
      const W along = x * A_(i, k) + y * A_(i, k + 1) + (three ? W(z * A_(i, k + 2)) : W(0));
      A_(i, k) -= along;
      A_(i, k + 1) -= along * q;
      if (three) A_(i, k + 2) -= along * r;
    }
  }

  MatrixOf<W> A_;
  W norm_;
  W shifted_;  ///< what exceptional shifts took off the diagonal
  std::vector<Eigenvalue<W>> found_;
};

}  // namespace gainsmith::numbers
