// Everything that a problem and its method say, bound once: programs with shapes and places.
//
// A problem and a method are read as texts (problem.h, method.h). bind() turns the two into one
// Design, and nothing behind it uses a syntax tree or a scope again. A Design holds no values but
// those that fixed its shapes; evaluate() gives values to its data and parameters (instance.h), and
// an override changes values, never a program.
//
// What the programs may use, as inputs by name:
//   data, parameters, assumptions    data and parameters declared before, dimensions
//   inequalities, objective, gains   all data and parameters, unknowns; a function's coefficients;
//                                    the variables of `forall` and of a gain that is a function
//   report, dynamics, claims, campaign              those, and gains and what moves
//   what is expected, searched or asked for         those, and `objective`
// Unknown functions and gains that are functions are called, and linked before evaluation
// (function.h, stated.h).
//
//   problem, method, component, declaration, shape_text, range   what was read: syntax trees
//   design, dynamics, formula, function, figure, system_figure    what was bound: programs
//   instance, structure            values of data and parameters
//   gains, stated, stated_file     results, and what they state
//   run_texts, dynamics_programs, measured   what runs read
//   campaign_record, figure_record   what runs found, as files keep it
//   names, estimate_name, words    rules of names, words of texts and results
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "expr/program/estimate.h"
#include "expr/program/program.h"
#include "model/dynamics.h"
#include "model/figure.h"
#include "model/formula.h"
#include "model/range.h"
#include "model/stated_file.h"
#include "model/system_figure.h"
#include "model/words.h"

namespace gainsmith::bind {
struct Names;  // the scopes that texts are bound in, for formulas that a gain file brings
}

namespace gainsmith::model {

struct Problem;  // problem.h: the texts, kept to bind again when a dimension changes

/// What was solved, so that a gain file is self-contained.
struct Statement {
  std::string method_name;
  std::string method_text;
  std::string problem_file;  ///< its name only, no folders of the machine
  std::string problem_text;
  std::string hash;                 ///< statement_hash
  std::vector<Setting> settings{};  ///< of the command line
  std::vector<StatedFile> files{};  ///< what the problem reads besides its text
};

struct Design {
  struct Datum {
    std::string name;
    expr::Shape shape;
    Structure structure = Structure::full;
    /// The problem's, the method's default, or the end of the range from which it is searched; none
    /// when only an override gives it.
    std::optional<Formula> value;
    std::optional<Range> range;   ///< from whose end the value is
    Place place;                  ///< of the value
    std::vector<Place> elements;  ///< row by row, when it is written element by element
    std::string declared;         ///< its shape, as written
    std::string missing;          ///< what is said when it has no value
    bool chosen = false;  ///< one of many, by orth, null or output_gain: gain files say which
    bool first = false;   ///< a parameter that is a number: it comes before the data
  };

  /// A convex quadratic form e'*Q*e of unknowns.
  struct Square {
    expr::Program weight;  ///< Q, of data
    std::string text;      ///< of the form
    Place place;           ///< of Q
  };

  /// A comparison of scalars that data and parameters must satisfy.
  struct Assumption {
    std::string name;
    std::vector<std::pair<expr::Program, bool>> differences;  ///< to be > 0 (true) or >= 0
    std::string text;
    std::vector<std::string> scalars;  ///< that occur in it
    Place place;                       ///< of one of them in the problem
  };

  /// A matrix or, with `variable`, a function of a scalar: a polynomial (function.h) unless a room
  /// chooses another basis.
  struct Unknown {
    std::string name;
    expr::Shape shape;
    Structure structure = Structure::full;
    std::string variable;  ///< empty: a matrix
    int degree = 0;        ///< of the polynomial
    std::optional<Formula> degree_formula;
    /// Where its digits are kept: a basis of Chebyshev polynomials; none: of powers.
    std::optional<Range> in;
    std::string declared;  ///< its shape as written: "n x n"
    Place place;
  };

  /// An unknown polynomial of several variables over its coefficients, which are unknowns.
  struct Polynomial {
    std::string signature;  ///< "V(x)"
    std::string text;       ///< "V_2_0*x(1)^2 + V_1_1*x(1)*x(2) + ..."
  };

  /// A variable of `forall`.
  struct Variable {
    std::string name;
    Over over = Over::interval;
    expr::Shape shape;
    std::vector<Formula>
        points;  ///< the two ends, the elements, or the vertices; none of all numbers
    Place place;
  };

  /// One comparison: the larger side minus the smaller one, to be > 0 (strict) or >= 0.
  struct Comparison {
    std::string name;  ///< of the inequality; "bounds.2" for the second of a chain
    expr::Program difference;
    bool strict = true;
  };

  /// A named matrix inequality, or a chain of them, for all values of its variables.
  struct Inequality {
    std::string name;
    std::vector<Variable> domain;
    std::vector<Comparison> comparisons;
    Place place;       ///< of the name
    Place that_place;  ///< of the comparison
    /// What is shown as a sum of squares (sos/program.h), for all values of its variables where
    /// these differences are >= 0, or of an equation 0.
    struct Where {
      expr::Program difference;
      bool equation = false;
      Place place;
    };
    struct SumOfSquares {
      std::vector<Where> where;
      std::optional<int> degree;
      bool adds_degree = false;
    };
    std::optional<SumOfSquares> sos{};

    /// Whether an unknown function is called in it.
    bool calls_functions() const;
  };

  /// A part of a gain formula next to an inverse, for the bound on the gain (lmi/gain_bounds.h):
  /// inv(S)*E, or E*inv(S).
  struct Product {
    struct Factor {
      std::optional<expr::Program> program;  ///< none: it has no value of its own
      std::string text;
      /// The calls of unknown functions in `text`: first byte, length.
      std::vector<std::pair<std::size_t, std::size_t>> calls;
    };
    std::string inverse;  ///< S as written: a square unknown or a call of one, "P", "P(t)"
    Factor inverted;      ///< S
    bool left = true;     ///< inv(S) is left of E
    Factor all;           ///< the product of all factors beside the inverse
    Factor nearest;       ///< the one next to it
  };

  /// The objective lambda_max(M, N): the smallest l with M <= l N, where N > 0.
  struct Quotient {
    expr::Program numerator;
    expr::Program denominator;
    std::string text;
    std::string denominator_text;
    Place place;
  };

  struct Gain {
    std::string name;
    std::string variable;  ///< empty: a matrix; otherwise a function of it
    expr::Shape shape;
    Formula formula;
    std::vector<Product> products;
    Product::Factor whole;  ///< the formula itself
  };

  struct State {
    std::string name;
    expr::Shape shape;
    std::optional<Formula> start;
  };

  struct Claim {
    std::string name;
    ClaimKind kind = ClaimKind::nonincreasing;
    Formula value;                     ///< scalar
    std::optional<Formula> flow_cost;  ///< cost
    std::optional<Formula> jump_cost;  ///< cost
    std::optional<Formula> factor;     ///< shrinks
    Place place;
    std::optional<Formula> bound{};     ///< below, above: of constants
    std::optional<Formula> after{};     ///< the time from which on it is claimed; none: the start
    std::optional<std::size_t> over{};  ///< the event of the dynamics just after whose jumps it is
    double tolerance = 0;               ///< relative to the bound (claims/claim_check.h)
  };

  struct Law {
    LawKind kind = LawKind::uniform;
    std::vector<Formula> values;  ///< constant: one; list: all
    Place place;
    std::optional<std::size_t> event{};  ///< of dynamics; none: of each that has a clock
  };

  struct Start {
    std::size_t state = 0;
    StartKind kind = StartKind::expression;
    /// One value; low and high, scalar or of the state's shape; the elements; of an ellipsoid
    /// center, matrix and level, or [low, high] of levels; center and deviation or covariance.
    std::vector<Formula> values;
    Place place;
    bool covariance = false;
  };

  /// To what runs are integrated; what is not given is as usual.
  struct RunAccuracy {
    std::optional<double> relative, absolute;
    std::vector<std::pair<std::size_t, double>> states;  ///< with an absolute one of their own
  };

  /// A Monte-Carlo campaign. Run i uses law i modulo their number.
  struct Campaign {
    std::uint64_t runs = 1000;
    std::uint64_t seed = 1;
    std::optional<Formula> horizon;
    std::optional<RunAccuracy> accuracy;
    std::vector<Law> laws;
    std::optional<Formula> first;
    std::vector<Start> starts;
    Place place;
  };

  struct ExpectedValue {
    std::string name;
    Formula what;
    std::optional<Formula> value, below, above;
    std::optional<double> relative;
    std::optional<double> absolute;
    Place place;
  };

  struct Expectation {
    std::optional<std::string> verdict, status, campaign;
    std::optional<std::vector<std::string>> active_bounds;
    std::vector<ExpectedValue> values;
    std::vector<ExpectedFigure> run;  ///< of the first run
    Place place;
  };

  /// What is searched besides the unknowns.
  struct Search {
    std::optional<Range> extreme;
    bool largest = true;
    std::optional<double> tolerance;
    std::vector<Range> over;
    std::optional<Formula> minimize;
    std::optional<Figure> run_figure;
    std::uint64_t runs = 1;
    int evaluations = 200;
  };

  /// A number that binding took from values: the columns of orth and null. When it changes, so do
  /// shapes, and the texts are bound again.
  struct Rank {
    expr::Program matrix;
    std::optional<expr::Program> tolerance;
    int rank = 0;
  };

  /// The same of units of states, which are numbers of the programs.
  struct Units {
    expr::Program A, C;
    std::vector<int> exponents;
  };

  /// The same of a matrix for which output_gain has found a gain.
  struct Plant {
    expr::Program matrix;
    numbers::Matrix value;
  };

  std::string name;  ///< of the problem
  std::string file;
  std::string method;
  std::string method_file;
  Place method_place;  ///< where the problem names it
  Statement statement;

  Dimensions dimensions;
  std::vector<Datum> data;
  std::vector<Datum> parameters;  ///< scalars
  std::vector<Assumption> assumptions;
  std::vector<Square> squares;
  std::vector<Unknown> unknowns;
  std::vector<Polynomial> polynomials;
  std::vector<Inequality> inequalities;
  /// What is necessary beside them, with its own unknowns: it may show that there are no gains, and
  /// is not solved otherwise.
  struct Necessary {
    std::vector<Unknown> unknowns;
    std::vector<Inequality> inequalities;
  };
  Necessary necessary;
  std::optional<Formula> objective;
  std::optional<Quotient> quotient;  ///< instead of an objective
  std::vector<Gain> gains;
  std::vector<NamedFormula> report;
  std::vector<SystemFigure> pictures;  ///< of linear systems
  Dynamics varied;  ///< uncertain data of the plant that pictures read, as noise drawn once a run
  /// The data, parameters, gains and reports that rest on a search over a box; others are not here.
  std::map<std::string, expr::Estimate> estimates;

  std::vector<State> states;  ///< of the dynamics, plant first: their first variables
  std::vector<Claim> claims;
  std::optional<Dynamics> dynamics;  ///< none: nothing moves

  SynthesisOptions synthesis;
  std::optional<Search> search;
  std::vector<Range> open;            ///< parameters without a value that synthesis searches for
  std::vector<Range> negotiable;      ///< scalars along which `explain` says how far one must go
  std::vector<Range> asked;           ///< ranges of the command line
  std::vector<NamedFormula> figures;  ///< scalars of the command line, shown of each result
  Campaign campaign;
  std::string no_campaign;  ///< why there is none, as problem or method say; empty: there may be
  std::optional<Expectation> expect;
  std::vector<Figure> compare;  ///< figures shown for all observers side by side

  std::vector<Rank> ranks;
  std::vector<Units> units;
  std::vector<Plant> plants;
  std::shared_ptr<const Problem> source;
  std::shared_ptr<const bind::Names> names;
};

using DesignPtr = std::shared_ptr<const Design>;

/// Whether a comparison ("flow", "flow.2", "flow.2 at i = 1") is one of an inequality of this name
/// ("flow", "flow at i = 1").
bool is_comparison_of(const std::string& comparison, const std::string& inequality);

/// The names of the scalar data and the parameters, in order: what may be overridden.
std::vector<std::string> scalar_names(const Design& design);

/// Whether it says how long a run is: by a horizon, or by measured data.
bool has_end(const Design& design);
/// The same, or a timer gives a length by default (hybrid/scenario.h).
bool ends(const Design& design);

/// InputError at `place` when `name` is none of scalar_names, with the nearest that is.
void check_scalar_name(const Design& design, const std::string& name, const Place& place);

}  // namespace gainsmith::model
