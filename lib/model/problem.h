// A problem as read: plant data, a method, how to simulate and what is expected. bind() makes a
// design of it (design.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "expr/text/ast.h"
#include "model/figure.h"
#include "model/method.h"
#include "model/stated_file.h"
#include "model/system_figure.h"

namespace gainsmith::model {

/// A value of `data` or `parameters`. A YAML list of numbers is a row, but a column where a column
/// is declared (`flat`).
struct Value {
  std::string name;
  expr::Expression value;  ///< without a root: a list of matrices, given for a family
  bool flat = false;
  Place place;
  bool list = false;              ///< a YAML list, whose elements a family takes for its members
  std::vector<Value> matrices{};  ///< of a list of matrices, which has no value as one expression
  std::string source{};           ///< of a matrix of a file: "A.csv", "plant.mat: A"
};

/// How the sampling intervals of a run are chosen.
struct SamplingLaw {
  LawKind kind = LawKind::uniform;
  std::vector<expr::Expression> values;  ///< constant: one; list: all
  Place place;
  std::string event{};  ///< of which it is the law; empty: of each that has a clock
};

/// Where a state starts.
struct InitialValue {
  std::string state;
  StartKind kind = StartKind::expression;
  /// One expression; low and high; the elements; center, matrix and level; or center and deviation
  /// or covariance.
  std::vector<Value> values;
  Place place;
  bool covariance = false;
};

/// To what runs of dynamics with events are integrated.
struct RunAccuracy {
  /// Of one state, or of each observer's that has the name.
  struct OfState {
    std::string state;
    double absolute = 0;
    Place place;
  };
  std::optional<double> relative;
  std::optional<double> absolute;  ///< of all states
  std::vector<OfState> states;     ///< of some
  Place place;
};

/// A Monte-Carlo campaign. Run i uses law i modulo their number.
struct Campaign {
  std::uint64_t runs = 1000;
  std::uint64_t seed = 1;
  std::optional<expr::Expression> horizon;  ///< continuous time
  std::optional<RunAccuracy> accuracy;
  std::vector<SamplingLaw> sampling;      ///< empty: those of hybrid/law.h
  std::optional<expr::Expression> first;  ///< first value of the timer; none: uniform in its range
  std::vector<InitialValue>
      initial;  ///< a state that is not listed starts where the method says, or in the box [-1, 1]
  Place place;
};

/// An expected number or matrix, with a tolerance or with bounds of each element.
struct ExpectedValue {
  std::string name;  ///< the expression as written, such as trace(P1)
  expr::Expression what;
  std::optional<Value> value, below, above;
  std::optional<double> relative;  ///< |found - value| <= relative * max |value|
  std::optional<double> absolute;  ///< |found - value| <= absolute, element by element
  Place place;
};

struct Expectation {
  std::optional<std::string> verdict;   ///< yes, no, undecided
  std::optional<std::string> status;    ///< optimal, infeasible, undecided
  std::optional<std::string> campaign;  ///< held, violated
  std::optional<std::vector<std::string>> active_bounds;
  std::vector<ExpectedValue> values;    ///< `objective` may be used as a name here
  std::vector<ExpectedFigureText> run;  ///< of the first run
  Place place;
};

/// What is searched besides the unknowns (docs/search.md).
struct Search {
  /// The scalar whose largest or smallest feasible value is wanted, found by bisection.
  std::optional<ScalarRange> extreme;
  bool largest = true;
  std::optional<double> tolerance;           ///< of the final bracket of `extreme`
  std::vector<ScalarRange> over;             ///< scalars that are optimised outside
  std::optional<expr::Expression> minimize;  ///< figure of `over` when there is no `extreme`
  std::optional<FigureText> run_figure;      ///< figure of `over`, of runs
  std::uint64_t runs = 1;                    ///< over which the mean of `run_figure` is taken
  int evaluations = 200;                     ///< of the figure
  Place place;
};

/// What the command line asks beside the file.
struct Questions {
  std::vector<ScalarRange> ranges;
  std::vector<expr::Expression> figures;  ///< scalars that are shown of each result
};

/// Data of which the plant has another value than the observers, chosen once a run.
struct UncertainText {
  std::string name;
  Dynamics::NoiseKind kind = Dynamics::NoiseKind::uniform;
  /// Low and high; center and deviation or covariance; vertices, one that names a family: its
  /// members.
  std::vector<Value> values;
  bool covariance = false;
  Place place;
};

/// Units as they are shown: one, or one for each element, column by column.
struct UnitText {
  std::string name;
  std::vector<std::string> units;
  Place place;
};

/// What the covariance of the error of an estimate is.
struct CovarianceText {
  std::string estimate;
  std::string covariance;
  Place place;
  Place covariance_place;
};

struct Problem {
  std::string name;
  std::string file;
  std::string text;
  std::string method_name;
  Place method_place;
  std::shared_ptr<const Method> method;
  std::vector<Value> data;
  std::vector<Let> functions;  ///< data that are functions: "f(x): ..."
  std::vector<Value> parameters;
  SynthesisOptions synthesis;
  std::optional<Search> search;
  std::vector<ScalarRange> negotiable;  ///< scalars along which `explain` says how far one must go
  Campaign campaign;
  std::string no_campaign;  ///< why there is none; empty: see the method's
  std::optional<Expectation> expect;
  std::vector<FigureText> compare;          ///< figures shown for all observers side by side
  std::vector<SystemFigureText> figures{};  ///< pictures of linear systems
  std::vector<Let> let;       ///< definitions of the problem, beside those of the method
  std::vector<Named> report;  ///< what is shown beside the method's report
  std::vector<UncertainText> uncertain;
  std::vector<UnitText> units;
  std::vector<CovarianceText> covariances;
  Questions questions;
  std::vector<Setting> settings;  ///< of the command line
  std::vector<StatedFile> files;  ///< what was read besides the text
};

}  // namespace gainsmith::model
