// y' = f(q, y) from q = 0 to 1 by extrapolation of the midpoint rule (Gragg 1965; Bulirsch
// and Stoer 1966), over any real scalar.
//
//   z_1 = y + h f(y),   z_{i+1} = z_{i-1} + 2 h f(z_i),   h = H/n,   n = 2 k
//   D_k = (z_{n-1} + z_n + h f(z_n))/2 - y
//   T_{k,1} = D_k,      T_{k,i+1} = T_{k,i} + (T_{k,i} - T_{k-1,i}) / ((n_k / n_{k-i})^2 - 1)
//
// D_k errs in even powers of h, so that each column of the table gains two orders. A step of the
// length H ends with the first k for which T_{k,k} and T_{k,k-1} agree.
//
// What f branches on (Watch) must keep its sign at the points of the last D_k, and stay away from 0
// by more than twice what it changes from point to point; otherwise the step is shortened, down to
// where f is taken as it comes. So steps go up to a zero crossing and do not pass over a pair of
// them. The lines through two points say where a crossing lies, and so how long the next step may
// be.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "numerics/matrix.h"

namespace gainsmith::numerics {

/// Why an integration ended before 1.
struct Unreached {
  double at = 0;  ///< q
  std::string why;
};

template <class Scalar>
class Extrapolation {
 public:
  using M = MatrixOf<Scalar>;
  /// InputError, such as the language throws, where there is no rate; such a step is shortened.
  using Rate = std::function<void(const Scalar& q, const M& y, M& rate)>;

  /// What f branches on.
  struct Watch {
    /// A column of numbers, of the first column of y; empty: f is smooth.
    std::function<void(const Scalar& q, const M& first, M& differences)> at;
    std::vector<bool> jumps{};  ///< by number: otherwise f has a kink
    /// Of a step that crosses a zero of one of them: where it begins.
    std::function<void(const Scalar& q, const M& y, Eigen::Index difference)> crossed{};
  };

  explicit Extrapolation(Rate rate, Watch watch = {})
      : rate_(std::move(rate)), watch_(std::move(watch)), table_(kColumns) {}

  /// y(1). Unreached is thrown where it ends before.
  M operator()(M y) {
    if (y.size() == 0) return y;
    const Scalar beyond = kEscaped * (Scalar(1) + y.cwiseAbs().maxCoeff());
    Scalar q(0), step(1);
    start_known_ = false;
    evaluations_ = 0;
    fault_.clear();
    while (q < Scalar(1)) {
      const bool last = step >= Scalar(1) - q;
      if (last) step = Scalar(1) - q;
      int columns = attempt(q, step, y);
      if (columns > 0 && !may_be_taken(q, step, y)) columns = kCrosses;
      if (columns > 0) {
        y += table_[static_cast<std::size_t>(columns - 1)];
        q = last ? Scalar(1) : Scalar(q + step);
        start_known_ = false;
        fault_.clear();
        step = std::min<Scalar>(step * growth(columns), clear_after(step));
        continue;
      }
      step = shorter(q, step, columns);
      if (!(step > (watch_.at ? kShortestAtZero : kShortest)))
        stop(q, y.cwiseAbs().maxCoeff() > beyond);
    }
    return y;
  }

 private:
  /// The most columns of the table: more where the scalar has more digits.
  static constexpr int kColumns = 6 + std::min(std::numeric_limits<Scalar>::digits10, 105) / 3;
  static constexpr int kGaveUp = 0;     ///< all columns were tried
  static constexpr int kFailed = -1;    ///< they do not converge
  static constexpr int kCrosses = -2;   ///< what f branches on comes near 0
  static constexpr int kNoRate = -3;    ///< at one of the points
  static constexpr int kMost = 400000;  ///< evaluations
  /// Steps below these parts of the whole time end the integration.
  const Scalar kShortest{0x1p-44};
  const Scalar kShortestAtZero{0x1p-51};  ///< where f is known to branch
  // The lengths below which zeros are crossed: what f does at a kink changes y by their square.
  const Scalar kAcrossJumps{0x1p-40};
  const Scalar kAcrossKinks{0x1p-24};
  // Of the distance to a zero crossing, and times that from it: steps of 6 points stay away.
  const Scalar kUpTo{0.7};
  const Scalar kAwayFrom{2.8};
  const Scalar kEscaped{1e6};
  /// Where T_{k,k} and T_{k,k-1} agree, relative: Decimal100 has digits to spare.
  const Scalar kError =
      std::max(Scalar(16) * std::numeric_limits<Scalar>::epsilon(), Scalar(1e-105));
  const Scalar kClose{1e-4};
  const Scalar kRounding = Scalar(256) * kError;  ///< where columns do not agree better

  /// By what the next step may be longer, from the columns that the last one took.
  static Scalar growth(int columns) {
    if (columns <= 4) return Scalar(4);
    if (columns < 2 * kColumns / 3) return Scalar(2);
    return columns + 1 < kColumns ? Scalar(1) : Scalar(0.75);
  }

  [[noreturn]] void stop(const Scalar& q, bool escaped) const {
    const auto at = static_cast<double>(q);
    if (escaped) throw Unreached{at, "it leaves every bound there"};
    if (!fault_.empty()) throw Unreached{at, fault_};
    throw Unreached{at, "the steps become too short"};
  }

  /// The columns that a step took, which is in the last of them; otherwise why there are none.
  int attempt(const Scalar& q, const Scalar& step, const M& y) {
    try {
      if (!start_known_) {
        evaluate(q, y, start_);
        if (watch_.at) watch_.at(q, y.col(0), before_);
      }
      start_known_ = true;
      return columns(q, step, y);
    } catch (const InputError& error) {
      fault_ = error.message();
      return kNoRate;
    }
  }

  int columns(const Scalar& q, const Scalar& step, const M& y) {
    Scalar before(0);
    for (int k = 1; k <= kColumns; ++k) {
      midpoint(q, step, y, 2 * k);
      if (!extrapolate(k)) return kFailed;
      if (k == 1) continue;
      const Scalar error = disagreement(k, step, y);
      // Where the rate jumps two columns may agree by chance.
      const bool settled = k > 2 && before <= kClose;
      if (settled && error <= kError) return k;
      if (k > 3 && error > before / Scalar(4)) return error <= kRounding ? k : kFailed;
      before = error;
    }
    return kGaveUp;
  }

  void evaluate(const Scalar& q, const M& y, M& rate) {
    if (++evaluations_ > kMost)
      throw Unreached{static_cast<double>(q), "it takes too many steps: the rate is stiff there"};
    rate_(q, y, rate);
    if (!is_finite(rate)) throw InputError({}, "the rate is not a finite number");
  }

  /// D of n parts to difference_.
  void midpoint(const Scalar& q, const Scalar& step, const M& y, int n) {
    const Scalar h = step / Scalar(n);
    if (watch_.at) points_.resize(y.rows(), n);
    last_.setZero(y.rows(), y.cols());
    difference_ = h * start_;
    for (int i = 1; i < n; ++i) {
      point_ = y + difference_;
      stage(Scalar(q + h * Scalar(i)), i);
      last_ += (h + h) * slope_;
      last_.swap(difference_);
    }
    point_ = y + difference_;
    stage(Scalar(q + step), n);
    difference_ = (last_ + difference_ + h * slope_) / Scalar(2);
  }

  /// The i-th point of a column.
  void stage(const Scalar& q, int i) {
    evaluate(q, point_, slope_);
    if (watch_.at) points_.col(i - 1) = point_.col(0);
  }

  /// Whether the step that ends with the last column crosses no zero; short ones may.
  bool may_be_taken(const Scalar& q, const Scalar& step, const M& y) {
    if (!is_watched()) return true;
    watch(q, step);
    for (Eigen::Index e = 0; e < before_.rows(); ++e) {
      const bool crosses =
          (before_(e) > Scalar(0)) != (watched_(e, watched_.cols() - 1) > Scalar(0));
      const bool is_short = step <= across(e);
      if (!is_short && (crosses || !stays_away(e))) return false;
      if (crosses && watch_.crossed) watch_.crossed(q, y, e);
    }
    return true;
  }

  /// Whether a difference is farther from 0 than twice what it changes from point to point; one
  /// that does not change is.
  bool stays_away(Eigen::Index e) const {
    using std::abs;
    Scalar last = before_(e);
    Scalar nearest = abs(last);
    Scalar change(0);
    for (Eigen::Index i = 0; i < watched_.cols(); ++i) {
      const Scalar next = watched_(e, i);
      nearest = std::min<Scalar>(nearest, abs(next));
      change = std::max<Scalar>(change, abs(Scalar(next - last)));
      last = next;
    }
    return change == Scalar(0) || nearest > change + change;
  }

  bool is_watched() const { return watch_.at && before_.size() > 0; }

  /// A step of that length may cross a zero.
  const Scalar& across(Eigen::Index e) const {
    return watch_.jumps[static_cast<std::size_t>(e)] ? kAcrossJumps : kAcrossKinks;
  }

  /// What f branches on at the points of the last column.
  void watch(const Scalar& q, const Scalar& step) {
    watched_.resize(before_.rows(), points_.cols());
    const Scalar h = step / Scalar(static_cast<int>(points_.cols()));
    for (Eigen::Index i = 0; i < points_.cols(); ++i) {
      watch_.at(Scalar(q + h * Scalar(static_cast<int>(i) + 1)), points_.col(i), watched_at_);
      watched_.col(i) = watched_at_;
    }
  }

  Scalar watched(Eigen::Index e, Eigen::Index point) const {
    return point == 0 ? before_(e) : watched_(e, point - 1);
  }

  /// The length after one with which there is no step: where it crosses a zero, up to short of
  /// that, or where that is nearer than across(), over it.
  Scalar shorter(const Scalar& q, const Scalar& step, int columns) {
    const Scalar usual = step / Scalar(columns == kGaveUp ? 2 : 4);
    if (!is_watched() || columns == kNoRate) return usual;
    if (columns != kCrosses) {
      try {
        watch(q, step);
      } catch (const InputError&) {
        return usual;
      }
    }
    std::optional<Scalar> nearest;
    const Eigen::Index points = watched_.cols();
    for (Eigen::Index e = 0; e < before_.rows(); ++e) {
      if (step <= across(e)) continue;
      for (Eigen::Index i = 1; i <= points; ++i) {
        const Scalar left = watched(e, i - 1), right = watched(e, i);
        if ((left > Scalar(0)) == (right > Scalar(0))) continue;
        const Scalar root = (Scalar(static_cast<int>(i) - 1) + left / (left - right)) * step /
                            Scalar(static_cast<int>(points));
        const Scalar length = std::max<Scalar>(across(e), kUpTo * root);
        if (!nearest || length < *nearest) nearest = length;
        break;
      }
    }
    return nearest && *nearest < step ? *nearest : usual;
  }

  /// How long the step after one may be that stays_away() as what f branches on goes on in a line
  /// through its last two points; across() at least.
  Scalar clear_after(const Scalar& step) const {
    using std::abs;
    Scalar length(1);
    if (!is_watched()) return length;
    const Eigen::Index points = watched_.cols();
    for (Eigen::Index e = 0; e < before_.rows(); ++e) {
      const Scalar last = watched(e, points), before = watched(e, points - 1);
      const Scalar change = abs(Scalar(last - before)) * Scalar(static_cast<int>(points));
      const bool nears = abs(last) < abs(before) && (last > Scalar(0)) == (before > Scalar(0));
      const Scalar most = abs(last) * step * (nears ? kUpTo : kAwayFrom);
      if (most < length * change) length = std::max<Scalar>(across(e), Scalar(most / change));
    }
    return length;
  }

  /// Row k of the table, in the place of row k - 1; whether it is finite.
  bool extrapolate(int k) {
    for (int i = 1; i < k; ++i) {
      M& old = table_[static_cast<std::size_t>(i - 1)];
      const Scalar ratio = Scalar(k) / Scalar(k - i);
      next_ = difference_ + (difference_ - old) / (ratio * ratio - Scalar(1));
      old.swap(difference_);
      difference_.swap(next_);
    }
    table_[static_cast<std::size_t>(k - 1)] = difference_;
    return is_finite(difference_);
  }

  /// Of T_{k,k} and T_{k,k-1}, for each element in parts of what it is and may become in the step,
  /// or of its column.
  Scalar disagreement(int k, const Scalar& step, const M& y) {
    const M& best = table_[static_cast<std::size_t>(k - 1)];
    const M& second = table_[static_cast<std::size_t>(k - 2)];
    size_ = y.cwiseAbs().cwiseMax((y + best).cwiseAbs()).cwiseMax((step * start_).cwiseAbs());
    Scalar worst(0);
    for (Eigen::Index j = 0; j < y.cols(); ++j) {
      const Scalar column = size_.col(j).maxCoeff() / Scalar(32);
      for (Eigen::Index i = 0; i < y.rows(); ++i) {
        const Scalar difference = best(i, j) - second(i, j);
        if (difference == Scalar(0)) continue;
        const Scalar part = std::max(size_(i, j), column);
        worst = std::max(worst, Scalar((difference < Scalar(0) ? -difference : difference) / part));
      }
    }
    return worst;
  }

  Rate rate_;
  Watch watch_;
  M points_;   ///< those of the last column, the first column of each
  M before_;   ///< what f branches on, at y
  M watched_;  ///< at the points, and at one of them
  M watched_at_;
  std::vector<M> table_;
  M start_;  ///< the rate at y
  M difference_, point_, slope_;
  M last_, next_, size_;  ///< of a midpoint, an extrapolation and a comparison
  bool start_known_ = false;
  int evaluations_ = 0;
  std::string fault_;  ///< since the last step
};

}  // namespace gainsmith::numerics
