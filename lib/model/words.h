// Words that texts, designs and results share.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace gainsmith::model {

/// The answer to "are there gains that satisfy every inequality?".
enum class Verdict { yes, no, undecided };
std::string to_string(Verdict verdict);

/// The answer of a run, and of a campaign.
enum class CampaignVerdict { held, violated, undecided };
std::string to_string(CampaignVerdict verdict);

enum class Structure { full, symmetric, diagonal, scalar };
/// "full", "symmetric", "diagonal", "scalar".
std::string to_string(Structure structure);

/// What a variable of `forall` runs over.
enum class Over {
  interval,  ///< all numbers between two ends
  reals,     ///< all numbers, or all columns of a length
  set,       ///< finitely many elements, numbers or matrices of one shape
  polytope   ///< all convex combinations of matrices of one shape
};

/// How an inequality is imposed for all values of its variables.
enum class Way {
  automatic,    ///< hull where it loses nothing, exchange elsewhere
  hull,         ///< at the vertices of the box of the ranges of its scalar functions
  exchange,     ///< at few points, to which the worst ones are added until none is left
  vertex_gains  ///< hull, with one matrix for each vertex in unknowns that are functions
};
std::string to_string(Way way);

/// What a simulation can check of the gains: from a time on, or just after the jumps of an event
/// alone, where a claim says so.
enum class ClaimKind {
  nonincreasing,  ///< value never increases, along flows and over jumps
  cost,           ///< int flow_cost dt + sum over jumps of jump_cost (before the jump) <= value at
                  ///< the start
  shrinks,        ///< value at the end of the run <= factor * value at the start
  below,          ///< value <= bound
  above           ///< value >= bound
};
std::string to_string(ClaimKind kind);

/// How the sampling intervals of a run are chosen, within the timer's [low, high].
enum class LawKind {
  constant,  ///< always the value
  uniform,   ///< independent, uniform in [low, high]
  extremes,  ///< independent, low or high with probability one half
  sinusoid,  ///< (high - low)/2 sin(t/high) + (high + low)/2 at a jump at time t
  list,      ///< the values in turn, again from the start when they are used up
  golden     ///< low + (high - low) frac((k + 1) 0.6180339887498949) at jump k = 0, 1, ...
};
std::string to_string(LawKind kind);

/// Where a state starts.
enum class StartKind {
  expression,  ///< may use data, gains and the states declared before it
  box,         ///< uniform in [low, high], element by element; low and high scalar or of the
               ///< state's shape
  list,        ///< run i takes element i modulo their number
  ellipsoid,   ///< uniform in {x: (x - center)' matrix (x - center) <= level}; of a column
  normal,      ///< as noise, once
  lognormal
};
inline bool has_center(StartKind kind) {
  return kind == StartKind::normal || kind == StartKind::lognormal;
}

struct BoundOfGain {
  std::string gain;
  double bound = 0;
  Place place;
};

/// Choices for the synthesis.
struct SynthesisOptions {
  Way way = Way::automatic;
  int slices = 1;                          ///< hull: equal parts of each interval
  double margin = 1e-9;                    ///< wished for of strict inequalities, without units
  std::optional<double> gain_bound = 1e4;  ///< none: off
  /// Of gains by their names, each in its own units: `gain_bound` is then the largest of them, and
  /// gains that are not here have none.
  std::vector<BoundOfGain> gain_bounds;
  /// The bound of a gain, as a part of `gain_bound`; none where it has none.
  std::optional<double> share_of_bound(const std::string& gain) const;
  /// States the bound; bounds of single gains keep their ratios, the largest becomes this one.
  void set_gain_bound(double bound);
  /// Whether the problem states it: one that does not guides the search and decides nothing, since
  /// it is a number in units.
  bool gain_bound_stated = false;
  /// Whether what double does not decide may take any time, not an allowance of work.
  bool full_effort = false;
};

/// Sizes of dimension names.
using Dimensions = std::map<std::string, int>;

/// Values for scalar data and parameters, by name, in place of those of the problem.
using Overrides = std::map<std::string, double>;

/// The file of places in a method of the program.
inline std::string method_file(std::string_view name) { return "method " + std::string(name); }
/// No file of a user has such a name: theirs have an ending.
inline bool is_method_file(std::string_view file) {
  return file.starts_with("method ") && file.find('.') == std::string_view::npos;
}

}  // namespace gainsmith::model
