// A problem: plant data, a method's name, how to simulate and what is expected.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "expr/ast.h"
#include "model/method.h"

namespace gainsmith::model {

/// A value of `data` or `parameters`. A YAML list of numbers is a row, but a column where a column
/// is declared (`flat`).
struct Value {
  std::string name;
  expr::Expression value;
  bool flat = false;
  Place place;
};

/// How the sampling intervals of a run are chosen, within the timer's [low, high].
struct SamplingLaw {
  enum class Kind {
    constant,  ///< always the value
    uniform,   ///< independent, uniform in [low, high]
    extremes,  ///< independent, low or high with probability one half
    sinusoid,  ///< (high - low)/2 sin(t) + (high + low)/2 at a jump at time t
    list       ///< the values in turn, again from the start when they are used up
  };
  Kind kind = Kind::uniform;
  std::vector<expr::Expression> values;  ///< constant: one; list: all
  Place place;
};

std::string to_string(SamplingLaw::Kind kind);

/// Where a state starts.
struct InitialValue {
  enum class Kind {
    expression,  ///< may use data, gains and the states declared before it
    box,  ///< uniform in [low, high], element by element; low and high scalar or of the state's
          ///< shape
    list  ///< run i takes element i modulo their number
  };
  std::string state;
  Kind kind = Kind::expression;
  std::vector<Value> values;  ///< one expression; low and high; or the elements
  Place place;
};

/// A Monte-Carlo campaign. Run i uses law i modulo their number.
struct Campaign {
  std::uint64_t runs = 1000;
  std::uint64_t seed = 1;
  std::optional<expr::Expression> horizon;  ///< continuous time
  std::vector<SamplingLaw> sampling;  ///< empty: uniform, extremes, sinusoid, both ends constant
  std::optional<expr::Expression> first;  ///< first value of the timer; none: uniform in its range
  std::vector<InitialValue>
      initial;  ///< a state that is not listed starts where the method says, or in the box [-1, 1]
  Place place;
};

/// An expected number or matrix, with a tolerance.
struct ExpectedValue {
  std::string name;  ///< the expression as written, such as trace(P1)
  expr::Expression what;
  Value value;
  std::optional<double> relative;  ///< |found - value| <= relative * max |value|
  std::optional<double> absolute;  ///< |found - value| <= absolute, element by element
  Place place;
};

struct Expectation {
  std::optional<std::string> verdict;   ///< yes, no, undecided
  std::optional<std::string> status;    ///< optimal, infeasible, undecided
  std::optional<std::string> campaign;  ///< held, violated
  std::optional<std::vector<std::string>> active_bounds;
  std::vector<ExpectedValue> values;  ///< `objective` may be used as a name here
  Place place;
};

/// How an inequality is imposed for all values of its variables.
enum class Way {
  automatic,    ///< hull where it loses nothing, exchange elsewhere
  hull,         ///< at the vertices of the box of the ranges of its scalar functions
  exchange,     ///< at few points, to which the worst ones are added until none is left
  vertex_gains  ///< hull, with one matrix for each vertex in unknowns that are functions
};

std::string to_string(Way way);

/// Choices for the synthesis.
struct SynthesisOptions {
  Way way = Way::automatic;
  int slices = 1;                          ///< hull: equal parts of each interval
  double margin = 1e-7;                    ///< of strict inequalities, relative to their scale
  std::optional<double> gain_bound = 1e4;  ///< none: off
};

/// What is searched besides the unknowns (docs/search.md).
struct Search {
  /// The scalar whose largest or smallest feasible value is wanted, found by bisection.
  std::optional<ScalarRange> extreme;
  bool largest = true;
  std::optional<double> tolerance;           ///< of the final bracket of `extreme`
  std::vector<ScalarRange> over;             ///< scalars that are optimised outside
  std::optional<expr::Expression> minimize;  ///< figure of `over` when there is no `extreme`
  int evaluations = 200;                     ///< of the figure
  Place place;
};

/// Values for scalar data and parameters, by name, in place of those of the problem.
using Overrides = std::map<std::string, double>;

struct Problem {
  std::string name;
  std::string file;
  std::string text;
  std::string method_name;
  Place method_place;
  std::shared_ptr<const Method> method;
  std::vector<Value> data;
  std::vector<Value> parameters;
  SynthesisOptions synthesis;
  std::optional<Search> search;
  std::vector<ScalarRange> negotiable;  ///< scalars along which `explain` says how far one must go
  Campaign campaign;
  std::optional<Expectation> expect;
};

}  // namespace gainsmith::model
