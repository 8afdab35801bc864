// The largest or smallest value of one scalar with the answer yes.
//
// At each value the answer is yes, no (solutions are excluded), undecided, or refused (the value
// makes no sense). First a few values spread over the whole range are asked, both ends among them:
// they show an answer that is not monotone. Then the bracket between the outermost yes and the
// nearest no beyond it is halved. A value that is undecided or refused ends neither side: the
// bracket is closed from the yes up to it and from the no down to it, and what lies between stays
// open and is reported.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "search/axis.h"

namespace gainsmith::search {

enum class Answer { yes, no, undecided, refused };

using Question = std::function<Answer(double)>;

/// Two values count as one when they are within `width`, or, relative, within `width` times the
/// smaller one in size.
struct Tolerance {
  double width = 0;  ///< positive
  bool relative = false;

  /// Smaller by a factor.
  Tolerance operator*(double factor) const { return {width * factor, relative}; }
  /// The width that is allowed at a value.
  double at(double value) const { return relative ? width * std::abs(value) : width; }
};

struct BisectOptions {
  bool largest = true;  ///< otherwise the smallest value with yes
  Tolerance tolerance;  ///< of each side of the bracket
  int spread = 9;       ///< values asked first, at least 2
  /// Asked after the spread: a value that may be a yes where the spread has none. Left out when it
  /// is outside of the axis.
  std::optional<double> known;
  /// Instead of the spread: the boundary is expected here. It is bracketed by growing steps from
  /// there; a boundary further inward, or an answer that is not monotone, may stay undetected.
  std::optional<double> guess;
  int evaluations = 200;  ///< at most, those of the spread included
};

struct Sample {
  double value = 0;
  Answer answer = Answer::undecided;
  int order = 0;  ///< the number of values that were asked before
};

/// `open` is empty when nothing was asked between `yes` and `no`: they meet within the tolerance if
/// the bisection is finished. Otherwise it holds the undecided or refused values next to `yes` and
/// next to `no`; without `no`, the outermost one.
struct Bisection {
  std::optional<double> yes;  ///< the outermost value with yes
  std::optional<double> no;   ///< the nearest value beyond it with no; none when there is none
  struct Open {
    double near_yes = 0;
    double near_no = 0;
  };
  std::optional<Open> open;
  /// Values with no that lie on the inner side of `yes`: the answer is not monotone, and other
  /// boundaries may lie between the values that were asked.
  std::vector<double> breaks;
  std::vector<Sample> samples;  ///< all that were asked, by value
  bool finished = false;        ///< not stopped, and within the number of evaluations
};

/// Asks the question on axis.low ... axis.high. Deterministic, one value after the other.
/// std::invalid_argument unless low < high, all is finite and the tolerance is positive; a relative
/// one needs low > 0.
Bisection bisect(const Question& question, const Axis& axis, const BisectOptions& options);

}  // namespace gainsmith::search
