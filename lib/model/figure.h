// Numbers that one reads from a run: a value at a moment, a peak, when something has settled.
//
//   {at: {event: leave, count: 2, side: after}, value: v}   v just before or after a jump
//   {at: {t: 10}, value: v}                                 v at a time, after its jumps
//   {peak: v}, {least: v}      the largest and the smallest value, along flows too
//   {settles: v, below: b}     the time from which on v stays below b; infinite when it does not
//   {rms: v, over: [a, b]}     the root of the mean of v^2 over these times
//   {integral: v, over: [a, b]}     the integral of v over these times
//   {nees: e, covariance: P, at: ...}     e' P^-1 e of an error and its covariance, at a moment
//   {nis: r, covariance: S, at: {event: sample}}     the mean of r' S^-1 r just before the jumps of
//                              an event that the observer sees
//   {count: event}, {passes: event}   how often it jumped; how often its loops ran in all
//   {lost: event}              how many of these jumps no observer saw
//   {ended: zeno}              why the run ended
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "expr/text/ast.h"
#include "model/formula.h"

namespace gainsmith::model {

enum class FigureKind {
  at_event,  ///< of `nees` too
  at_time,   ///< of `nees` too
  peak,
  least,
  settles,
  rms,
  integral,
  nis,
  count,
  passes,
  lost,
  ended
};

/// Whether it is a number of events.
constexpr bool is_whole(FigureKind kind) {
  return kind == FigureKind::count || kind == FigureKind::passes || kind == FigureKind::lost;
}

/// A figure as read.
struct FigureText {
  FigureKind kind = FigureKind::peak;
  std::string title;     ///< as it is shown: "peak norm(e)"
  std::string observer;  ///< of which it is; empty: of each that has the names, or of none
  std::optional<expr::Expression> value;
  std::optional<expr::Expression> error;  ///< of `nees` and `nis`: then value is e' P^-1 e
  std::string event;
  std::int64_t count = 1;
  bool after = false;
  std::vector<expr::Expression> numbers;  ///< the time, the level below, or the two ends
  Place place;
};

/// What a figure must be.
struct ExpectedFigureText {
  FigureText figure;
  std::optional<expr::Expression> is, below, above;
  std::string ending;  ///< of `ended`
  std::optional<double> relative;
  std::optional<double> absolute;
};

struct Figure {
  FigureKind kind = FigureKind::peak;
  std::string title;
  std::string observer;
  std::optional<Formula> value;  ///< 1 x 1
  std::int64_t elements = 0;     ///< of `nees` and `nis`: those of the error
  std::size_t event = 0;
  std::int64_t count = 1;
  bool after = false;
  std::vector<Formula> numbers;  ///< of constants
  Place place;
};

struct ExpectedFigure {
  Figure figure;
  std::optional<Formula> is;
  std::optional<Formula> below, above;  ///< at most, at least
  std::string ending;
  std::optional<double> relative;
  std::optional<double> absolute;
};

}  // namespace gainsmith::model
