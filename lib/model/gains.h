// What synth writes and verify reads: gains, the statement that was solved and how well it holds.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/design.h"
#include "model/words.h"
#include "numbers/matrix.h"

namespace gainsmith::model {

using NamedMatrices = std::vector<std::pair<std::string, numbers::Matrix>>;

/// One matrix inequality at the decimals as written.
struct Margin {
  std::string name;  ///< of the requirement; "jump", or "bounds.1" in a chain
  bool strict = true;
  /// The smallest eigenvalue of D^-1/2 M D^-1/2 with D = diag(M), over all points of `forall`: from
  /// 0 to 1 where M > 0, the same in all units.
  double reached = 0;
  double required = 0;             ///< wished for
  double smallest_eigenvalue = 0;  ///< of M, in the data's units
  std::string worst_point;         ///< "tau = 0"; empty without forall
  bool holds = false;              ///< shown
  bool fails = false;              ///< shown; neither: not shown

  /// A minimum has its margin in the solver's units, within this of the margin in its own diagonal.
  static constexpr double kSame = 0.5;
  bool is_below() const { return strict && reached < required; }
  bool is_far_below() const { return strict && reached < kSame * required; }
};

/// A bound on a gain, so that an infimum that is not attained gives finite gains.
struct GainBound {
  std::string what;    ///< "inv(P2)*X"
  double bound = 0;    ///< allowed
  double reached = 0;  ///< in the same measure
  bool active = false;
  bool is_balanced = false;  ///< the default, in balanced units; otherwise in those of the file
};

/// Multipliers that are sums of c z z* at a root of a polynomial, in fractions
/// (verdict/algebraic_multipliers.h).
struct AlgebraicRecord {
  using Fractions = std::vector<std::string>;
  struct Term {
    std::string block;              ///< inequality and point
    std::vector<Fractions> vector;  ///< the rows of Z
    Fractions weight;               ///< of 1, l + m and l m
    int step = 1;                   ///< of a chain of rational ones
  };
  std::string of;  ///< the matrix whose eigenvalue the root is, "A"; empty: all is rational
  double re = 0, im = 0;
  Fractions polynomial;
  std::vector<Term> terms;

  /// Of the chain; 1 for a certificate without one.
  int steps() const;
};

/// The certificate of a no, as it was checked on the decimals of the file (verdict/refutation.h),
/// or of what is only sufficient for the inequalities.
struct CertificateRecord {
  bool exact =
      false;  ///< no solution, shown; otherwise none survives a relative change of that size
  double backward_error = 1;  ///< rounded upward
  int digits = 0;             ///< of the arithmetic that it was checked in
  /// One multiplier matrix for each inequality and point, and for the bounds on gains that it
  /// needs: its name and the matrix.
  NamedMatrices multipliers;
  /// What it is about: the "problem", or a condition that is only sufficient for its inequalities:
  /// their "hull", the test at the "vertices", or "sums of squares" of their degrees
  /// (docs/gain-file.md).
  std::string about = "problem";
  std::optional<AlgebraicRecord> algebraic{};
  /// Of sums of squares (sos/moments.h): a fraction for each monomial, "row(1)*row(2)*x(1)", of each
  /// inequality and each element of the sets of its variables.
  std::vector<std::map<std::string, std::string>> moments{};

  bool is_about_problem() const { return about == "problem"; }
  bool is_about_squares() const { return about == "sums of squares"; }
};

/// What it shows: "no solution exists"; of one that is not exact, "no solution survives a relative
/// change of 1.2e-94 of the coefficients".
std::string shown_by(const CertificateRecord& certificate);

/// "multipliers at the eigenvalue 0.1 + 2i of A", "rational multipliers".
std::string to_string(const AlgebraicRecord& algebraic);

/// "the decimals of the file", "the hull", "the vertex test", "sums of squares of these degrees".
std::string subject_of(const CertificateRecord& certificate);

/// What is added to "infeasible": "", " for the hull only", " for the vertex test only", " as sums
/// of squares of these degrees".
std::string limits_of(const CertificateRecord& certificate);

/// An inequality as a sum of squares (sos/program.h), in fractions: with z the basis and Q the Gram
/// matrix of each of the squares,
///   row'M(x) row = sum of times(x) z'Qz + sum of times(x) times the free polynomials.
struct SumOfSquaresRecord {
  struct Square {
    int times = 0;                   ///< 0: 1; k: the k-th of the polynomials that are >= 0
    std::vector<std::string> basis;  ///< "x(1)^2", "row(1)*x(2) - 1/3*row(2)"
    std::vector<std::vector<std::string>> gram;  ///< the lower triangle, row by row
  };
  struct Free {
    int times = 0;  ///< k: the k-th of the polynomials that are 0
    std::string polynomial;
  };
  std::string name;                    ///< of the comparison
  std::vector<std::string> variables;  ///< "x(1)"
  std::vector<Square> squares;
  std::vector<Free> free;
};

/// The multiplier of an inequality at a point of its domain, or of a bound on gains, at a minimum:
/// adding t*I to its larger side there lowers the minimum by at most `trace` times t.
struct Multiplier {
  std::string name;   ///< of the comparison, or "bound on inv(P)*Y"
  std::string point;  ///< as that of a margin
  double trace = 0;
};

/// The cause of a result that no solver was asked for.
constexpr const char* kNothingToSolve = "nothing to solve";

struct SolverRecord {
  std::string status;  ///< optimal, infeasible, undecided
  std::string cause;
  std::string message;  ///< notes, with "; " between them
  int iterations = 0;
  double relative_gap = 0;
  double primal_infeasibility = 0;
  double dual_infeasibility = 0;
  std::string precision;
  bool out_of_allowance = false;  ///< more work might decide (base/stop.h)
  bool unbounded = false;         ///< the solver finds the objective unbounded below

  void add_message(const std::string& text) { message += (message.empty() ? "" : "; ") + text; }
};

/// What moving scalars and unknowns together at the end of a search did
/// (design/joint_refinement.h).
struct RefinementRecord {
  double before = 0;            ///< the figure
  std::optional<double> after;  ///< none when there was nothing to compare
  bool kept = false;            ///< the figure improved and every inequality holds with its margin
  std::string cause;            ///< why the smooth solver stopped
};

/// How a search over scalars ended (docs/search.md). The gains are those of the best value.
struct SearchRecord {
  std::string figure;           ///< "largest T2", "objective", "trace(P1)", "margin"
  std::optional<double> value;  ///< of the figure; none when nothing feasible was found
  std::optional<double> error;  ///< of it, where it is of runs; infinite: it is not known
  std::optional<double>
      beyond;  ///< the nearest value beyond it that is infeasible by a checked certificate
  std::vector<double> open;    ///< undecided or refused ones next to `value` and `beyond`, or empty
  std::vector<double> breaks;  ///< infeasible, on the inner side of `value`
  std::optional<CertificateRecord> certificate;  ///< at `beyond`
  std::vector<std::string> over;                 ///< the scalars that were optimised outside
  std::vector<std::string> at_end;               ///< those of `over` found at an end of their range
  int evaluations = 0;
  int feasible = 0;       ///< of the evaluations
  bool finished = false;  ///< neither interrupted nor out of evaluations
  std::optional<RefinementRecord> joint_refinement;
};

/// sha256 of the method's text, a zero byte and the problem's text; where there are settings or
/// files, their parts follow, each behind a zero byte (docs/gain-file.md).
std::string statement_hash(const Statement& statement);

/// A gain that is a function of a scalar.
struct GainFunction {
  enum class Kind {
    polynomial,  ///< the sum of coefficients[k] * variable^k
    vertices,    ///< the formula, over unknown functions with one coefficient a vertex
    formula      ///< any other formula over data, parameters and unknowns
  };
  std::string name;
  std::string variable;
  Kind kind = Kind::formula;
  std::string formula;                        ///< in the matrix language
  std::vector<numbers::Matrix> coefficients;  ///< polynomial
};

std::string to_string(GainFunction::Kind kind);

/// An unknown function over its coefficients: "Y(tau)", "Y_0 + Y_1*tau".
struct StatedFunction {
  std::string signature;
  std::string text;
  /// Of a function that was synthesized here; none when it was read from a file.
  std::optional<expr::Program> body;
};

struct Gains;

/// The sum that a function is with the values of its coefficients, six significant digits:
/// "0.5*x(1)^2 - 1.2*x(1)*x(2)"; of a function whose coefficients are not all numbers, none.
std::optional<std::string> with_values(const StatedFunction& function, const Gains& gains);

/// The shortest decimal of a double. Zero keeps its sign as "-0.0", since JSON reads "-0" as a whole
/// number, which has none.
std::string printed(double value);

/// A matrix as a gain file prints it. What the file states are these decimals; doubles are their
/// roundings, and a proof computes with the decimals.
struct Decimals {
  std::string key;  ///< "gains.L", "gain_functions.K.coefficients[1]", "searched.T2"
  expr::Shape shape;
  std::vector<std::string> elements;  ///< row by row
};

struct Gains {
  std::string problem_name;
  Verdict verdict = Verdict::undecided;
  SolverRecord solver;
  std::optional<double> objective;
  /// Gains beyond the gain bound were found, of this size, and none within it.
  std::optional<double> bound_only;
  /// A yes is about a solution within this of the unknowns, element by element: no decimals satisfy
  /// the equations. None: it is about the decimals.
  std::optional<double> solution_within;
  std::optional<double> objective_lower_bound;  ///< of the problem without margins, by weak duality
  /// Those that show the lower bound, as in CertificateRecord; none where it is of a face.
  NamedMatrices optimum_multipliers;
  std::vector<Multiplier> multipliers;       ///< of a minimum; a gain file does not keep them
  NamedMatrices gains;                       ///< constant ones
  std::vector<GainFunction> gain_functions;  ///< the others
  NamedMatrices unknowns;
  /// How unknown functions follow from `unknowns`.
  std::vector<StatedFunction> functions;
  NamedMatrices report;  ///< what the method asks to be shown
  /// The reports that have no value at these gains, each with the reason.
  std::map<std::string, std::string> not_computed;
  /// The reports whose rows are the real and imaginary parts of eigenvalues. A gain file does not
  /// keep that.
  std::set<std::string, std::less<>> eigenvalues;
  /// The gains, reports, data and parameters that are estimates, found by a search over a box:
  /// "estimate from below".
  std::map<std::string, std::string> estimates;
  NamedMatrices parameters;
  /// The data that choose a basis (chooses_basis of instance.h): that which the gains are in.
  NamedMatrices bases;
  /// Scalars that a search set: they replace those of the statement. Their decimals count.
  Overrides searched;
  std::optional<SearchRecord> search;
  std::vector<Margin> margins;
  std::vector<GainBound> bounds;
  std::optional<CertificateRecord> certificate;
  std::vector<SumOfSquaresRecord> sums_of_squares;
  Statement statement;
  /// Of the matrices that were read with other decimals than printed(): all elements, by key.
  std::map<std::string, std::vector<std::string>> decimals;
  /// Read with a results_hash of its own that is not that of what was read.
  bool is_edited = false;
  std::string file;                                     ///< where it was read, for messages
  std::string version;                                  ///< of gainsmith
  std::vector<std::pair<std::string, double>> timings;  ///< seconds; apart from all results

  const numbers::Matrix* find(const std::string& name) const;
};

/// The key of a coefficient of a gain that is a polynomial.
std::string coefficient_key(const std::string& gain, std::size_t k);

/// The decimals of the matrix that is under a key: those that were read, as long as the matrix
/// holds their doubles, otherwise printed().
Decimals decimals_at(const Gains& gains, const std::string& key, const numbers::Matrix& matrix);

/// sha256 of the statement's hash and of the decimals of all that a proof needs besides
/// (docs/gain-file.md).
std::string results_hash(const Gains& gains);

/// The decimals of a gain, a coefficient of a gain that is a polynomial ("K_1"), an unknown, a
/// parameter or a searched scalar: the first of that name in this order. None for other names.
std::optional<Decimals> decimals_of(const Gains& gains, const std::string& name);

}  // namespace gainsmith::model
