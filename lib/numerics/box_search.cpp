#include "numerics/box_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/stop.h"

namespace gainsmith::numerics {

namespace {

using Index = Eigen::Index;

/// Searches in coordinates u from 0 to 1, of those alone whose ends differ.
class BoxSearch {
 public:
  BoxSearch(const std::function<double(const Vector&)>& f, const Vector& low, const Vector& high)
      : f_(f), low_(low), high_(high) {
    for (Index i = 0; i < low.size(); ++i)
      if (low(i) < high(i)) axes_.push_back(i);
  }

  BoxPoint run() {
    constexpr double kFine = 1e-10;
    constexpr int kFewRounds = 2, kManyRounds = 20;
    constexpr std::size_t kFinally = 3;
    if (axes_.empty()) return {low_, f_(low_)};
    const double coarse = std::min(1e-3, spacing() / 32);
    add_samples();
    std::vector<Sample> found;
    for (const Sample& start : starts())
      found.push_back(climbed(start, spacing(), coarse, kFewRounds));
    sort(found);
    found.resize(std::min(found.size(), kFinally));
    for (Sample& best : found)
      best = climbed(scanned(std::move(best)), spacing(), coarse, kFewRounds);
    for (Sample& best : found) best = climbed(best, coarse, kFine, kManyRounds);
    sort(found);
    return {placed(found.front().u), found.front().value};
  }

 private:
  struct Sample {
    Vector u;
    double value;
  };

  Index dimension() const { return static_cast<Index>(axes_.size()); }

  /// The ends of the box are met exactly.
  Vector placed(const Vector& u) const {
    Vector x = low_;
    for (Index k = 0; k < dimension(); ++k) {
      const Index i = axes_[static_cast<std::size_t>(k)];
      x(i) = u(k) >= 1 ? high_(i) : low_(i) * (1 - u(k)) + high_(i) * u(k);
      x(i) = std::clamp(x(i), low_(i), high_(i));
    }
    return x;
  }

  Sample sample(const Vector& u) const {
    check_stop();
    const Vector inside = u.cwiseMax(0).cwiseMin(1);
    return {inside, f_(placed(inside))};
  }

  /// Best first, of equal ones the one that was found first.
  static void sort(std::vector<Sample>& samples) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.value > b.value; });
  }

  Index evenly_spread() const { return std::min<Index>(1024 * dimension(), 16384); }

  /// How far the evenly spread points lie apart, about.
  double spacing() const {
    return std::min(0.25, std::pow(static_cast<double>(evenly_spread()),
                                   -1 / static_cast<double>(dimension())));
  }

  void add_samples() {
    constexpr Index kMostCorners = 12;
    const Index n = dimension();
    const Vector middle = Vector::Constant(n, 0.5);
    samples_.push_back(sample(middle));
    if (n <= kMostCorners)
      for (unsigned corner = 0; corner < 1U << n; ++corner) {
        Vector u(n);
        for (Index k = 0; k < n; ++k) u(k) = (corner >> k) % 2;
        samples_.push_back(sample(u));
      }
    for (Index k = 0; k < n; ++k)
      for (const double end : {0.0, 1.0}) {
        Vector u = middle;
        u(k) = end;
        samples_.push_back(sample(u));
      }
    const Vector step = irrational_step(n);
    for (Index k = 1; k <= evenly_spread(); ++k) {
      Vector u = middle + static_cast<double>(k) * step;
      for (double& coordinate : u) coordinate -= std::floor(coordinate);
      samples_.push_back(sample(u));
    }
  }

  /// 1/g, 1/g^2, ... with g^(n+1) = g + 1: multiples of it, modulo 1, fill the unit box evenly.
  static Vector irrational_step(Index n) {
    double g = 2;
    for (int k = 0; k < 64; ++k) g = std::pow(1 + g, 1 / static_cast<double>(n + 1));
    Vector step(n);
    for (Index k = 0; k < n; ++k) step(k) = std::pow(g, -static_cast<double>(k + 1));
    return step;
  }

  /// The best samples that are apart from better ones: of a line with many tops the best of each.
  std::vector<Sample> starts() {
    const double apart_by = std::min(0.05, 3 * spacing());
    const std::size_t most = axes_.size() == 1 ? 64 : 8 + 2 * axes_.size();
    sort(samples_);
    std::vector<Sample> chosen;
    for (const Sample& sample : samples_) {
      if (chosen.size() == most) break;
      const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](const Sample& other) {
        return (other.u - sample.u).lpNorm<Eigen::Infinity>() >= apart_by;
      });
      if (apart) chosen.push_back(sample);
    }
    return chosen;
  }

  /// From line to line along the axes through the whole box, as long as one leads higher: other
  /// tops of functions that are nearly sums.
  Sample scanned(Sample best) const {
    constexpr int kPoints = 64;
    const Index n = dimension();
    for (Index k = 0, idle = 0; idle < n; k = (k + 1) % n, ++idle) {
      const Vector from = best.u;
      for (int point = 0; point <= kPoints; ++point) {
        Vector u = from;
        u(k) = static_cast<double>(point) / kPoints;
        Sample tried = sample(u);
        if (!(tried.value > best.value)) continue;
        best = std::move(tried);
        idle = -1;
      }
    }
    return best;
  }

  /// Simplices and steps in turn, until neither gets higher.
  Sample climbed(Sample best, double step, double finest, int rounds) const {
    constexpr double kGain = 1e-14;
    for (int round = 0; round < rounds; ++round) {
      const double before = best.value;
      best = by_simplex(best, step, finest);
      best = by_steps(best, step, finest);
      if (best.value - before <= kGain * std::abs(before)) break;
    }
    return best;
  }

  /// Nelder and Mead, with what leaves the box put back to its boundary.
  Sample by_simplex(const Sample& start, double step, double finest) const {
    const Index n = dimension();
    const int most = 200 * static_cast<int>(n + 1);
    std::vector<Sample> simplex = {start};
    for (Index k = 0; k < n; ++k) {
      Vector u = start.u;
      u(k) += u(k) + step <= 1 ? step : -step;
      simplex.push_back(sample(u));
    }
    for (int iteration = 0; iteration < most; ++iteration) {
      sort(simplex);
      double size = 0;
      for (const Sample& sample : simplex)
        size = std::max(size, (sample.u - simplex.front().u).lpNorm<Eigen::Infinity>());
      if (size < finest) break;
      renew(simplex);
    }
    sort(simplex);
    return simplex.front();
  }

  /// One step of a sorted simplex: its worst point is reflected, stretched or contracted, or else
  /// all shrink towards the best.
  void renew(std::vector<Sample>& simplex) const {
    Vector centre = Vector::Zero(dimension());
    for (std::size_t k = 0; k + 1 < simplex.size(); ++k) centre += simplex[k].u;
    centre /= static_cast<double>(simplex.size() - 1);
    Sample& worst = simplex.back();
    const auto along = [&](double factor) { return sample(centre + factor * (centre - worst.u)); };
    const Sample reflected = along(1);
    if (reflected.value > simplex.front().value) {
      Sample stretched = along(2);
      worst = stretched.value > reflected.value ? std::move(stretched) : reflected;
    } else if (reflected.value > simplex[simplex.size() - 2].value) {
      worst = reflected;
    } else {
      Sample contracted = along(reflected.value > worst.value ? 0.5 : -0.5);
      if (contracted.value > std::max(reflected.value, worst.value)) {
        worst = std::move(contracted);
        return;
      }
      for (std::size_t k = 1; k < simplex.size(); ++k)
        simplex[k] = sample((simplex[k].u + simplex.front().u) / 2);
    }
  }

  /// Steps along the axes, and along those of a reflection that is another one after each failure:
  /// on a ridge no fixed set of directions leads upward.
  Sample by_steps(Sample best, double step, double finest) const {
    constexpr double kLongest = 0.25;
    const Index n = dimension();
    const Vector turn = irrational_step(n);
    for (int trial = 0; step >= finest; ++trial) {
      Vector w = Vector::Zero(n);
      if (trial % 2 == 1)
        w = (trial * turn).unaryExpr([](double x) { return 2 * (x - std::floor(x)) - 1; });
      const double size = w.squaredNorm();
      bool higher = false;
      for (Index k = 0; k < 2 * n; ++k) {
        Vector direction = (k % 2 == 0 ? step : -step) * Vector::Unit(n, k / 2);
        if (size > 0) direction -= 2 * w.dot(direction) / size * w;
        Sample tried = sample(best.u + direction);
        if (!(tried.value > best.value)) continue;
        best = std::move(tried);
        higher = true;
      }
      step = higher ? std::min(2 * step, kLongest) : step / (trial % 2 == 1 ? 2 : 1);
      if (trial > 100'000) break;
    }
    return best;
  }

  const std::function<double(const Vector&)>& f_;
  const Vector& low_;
  const Vector& high_;
  std::vector<Index> axes_;
  std::vector<Sample> samples_;
};

}  // namespace

BoxPoint largest_over_box(const std::function<double(const Vector&)>& f, const Vector& low,
                          const Vector& high) {
  return BoxSearch(f, low, high).run();
}

}  // namespace gainsmith::numerics
