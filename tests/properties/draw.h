// What the families draw: numbers, coordinates, units and distances to a threshold.
//
// Every case is a pure function of (seed, case). It is made in coordinates z = T z', T = U S with
// an integer matrix U of determinant 1 and a diagonal S of units, and in a unit of time: neither
// changes the truth of an inequality, as P -> T'PT and A -> T^-1 A T / c do not.
#pragma once

#include <cstdint>
#include <optional>

#include "base/random.h"
#include "properties/exact.h"

namespace gainsmith::tests::properties {

/// Other units for the states, time and the like of a case that is otherwise the same.
struct OtherUnits {
  std::uint64_t seed = 0;
  bool powers_of_two = true;
};

/// T and its inverse.
struct Coordinates {
  ExactMatrix T;
  ExactMatrix inverse;
};

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t index, std::optional<OtherUnits> others = {});

  int below(int count) { return static_cast<int>(stream_.uniform() * count); }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool chance(double probability) { return stream_.uniform() < probability; }
  /// A whole number of hundredths in [low, high].
  Exact hundredths(int low, int high) { return Exact(between(low, high)) / 100; }

  /// Above the threshold or below it; the same for the whole case.
  bool is_yes() const { return yes_; }
  /// How far from it, relatively: 0.05 to 1, or 1e-2 to 1e-5, or 1e-6; positive where the answer is
  /// yes. `boundary`: 0, a no, now and then.
  Exact distance(bool boundary = false);
  /// The same within (0, 1/2].
  Exact small_distance(bool boundary = false);

  Coordinates coordinates(int n);
  /// A diagonal change of units alone.
  Coordinates scales(int n);
  Exact unit();
  /// A change of coordinates, of units, or a threshold that is near: not for everyone to decide.
  bool is_easy() const { return !units_ && shear_ < 2 && closeness_ == 0; }

 private:
  Coordinates shears(int n);

  RandomStream stream_;
  std::optional<RandomStream> others_;
  bool others_two_ = true;
  bool yes_;
  bool units_;
  int shear_;      ///< 0 none, 1 moderate, 2 with condition 1e8
  int closeness_;  ///< 0 far, 1 near, 2 within 1e-6
};

/// A symmetric matrix of whole numbers in [-5, 5].
ExactMatrix symmetric(Draw& draw, int n);

}  // namespace gainsmith::tests::properties
