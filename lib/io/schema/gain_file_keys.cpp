// The keys of gain files.
#include <array>

#include "io/schema/keys.h"

namespace gainsmith::io {

namespace {

constexpr std::array kKeysOfDocument = {
    Key{"gainsmith", "text", "the version that wrote the file", kRequired},
    Key{"problem", "text", "the name of the problem", kRequired},
    Key{"verdict", "'yes' | 'no' | 'undecided'", "whether there are gains", kRequired},
    Key{"status", "text", "of the solver"},
    Key{"cause", "text", "why the solver stopped"},
    Key{"objective", "number", "the objective at the unknowns"},
    Key{"objective_lower_bound", "number", "a bound on the objective, without margins"},
    Key{"solution_within", "number", "distance of the solution that holds from the unknowns"},
    Key{"gains", "{rows}", "the constant gains", kRequired},
    Key{"gain_functions", "{gain function}", "gains that are functions of a scalar"},
    Key{"unknowns", "{rows}", "the unknowns", kRequired},
    Key{"functions", "{text}", "unknown functions over the unknowns"},
    Key{"report", "{rows | nothing}", "what method and problem show; null: not computed"},
    Key{"not_computed", "{text}", "why an entry of report has no value"},
    Key{"estimates", "{text}", "what is only an estimate"},
    Key{"parameters", "{rows}", "the method's parameters", kRequired},
    Key{"bases", "{rows}", "data that choose a basis"},
    Key{"searched", "{number}", "scalars that a search set"},
    Key{"search", "search", "how the search ended"},
    Key{"margins", "[margin]", "how well each inequality holds", kRequired},
    Key{"bounds", "[bound]", "the bounds on the gains", kRequired},
    Key{"certificate", "certificate", "of a no"},
    Key{"optimum", "{rows}", "multipliers that show objective_lower_bound"},
    Key{"sums_of_squares", "[sum of squares]", "the identities that show inequalities"},
    Key{"proof", "proof", "that the results are those of the statement"},
    Key{"solver", "solver", "what the solver says", kRequired},
    Key{"statement", "statement", "the problem that was solved", kRequired},
    Key{"timings", "{number}", "seconds", kRequired}};

constexpr std::array kKeysOfGainFunction = {
    Key{"of", "text", "the variable", kRequired},
    Key{"kind", "'polynomial' | 'vertices' | 'formula'", "", kRequired},
    Key{"formula", "text", "", kRequired}, Key{"coefficients", "[rows]", "of a polynomial"}};

constexpr std::array kKeysOfMargin = {
    Key{"name", "text", "of the inequality", kRequired},
    Key{"strict", "truth", "", kRequired},
    Key{"holds", "truth", "", kRequired},
    Key{"reached", "number", "the smallest eigenvalue, relative", kRequired},
    Key{"required", "number", "wished for", kRequired},
    Key{"smallest_eigenvalue", "number", "in the data's units", kRequired},
    Key{"worst_point", "text", "of 'forall'", kRequired}};

constexpr std::array kKeysOfBound = {
    Key{"gain", "text", "", kRequired}, Key{"bound", "number", "", kRequired},
    Key{"reached", "number | nothing", "", kRequired}, Key{"active", "truth", "", kRequired},
    Key{"balanced_units", "truth", "of a bound that the problem does not state"}};

constexpr std::array kKeysOfCertificate = {
    Key{"exact", "truth", "no solution exists, shown", kRequired},
    Key{"shows", "text", "what it shows, in words"},
    Key{"about", "text"},
    Key{"backward_error", "number", "", kRequired},
    Key{"digits", "whole", "", kRequired},
    Key{"multipliers", "{rows}", "", kRequired},
    Key{"algebraic", "algebraic", "exact multipliers, at an eigenvalue or rational ones"},
    Key{"moments", "[{text}]", "of each inequality, where it is about sums of squares"}};

constexpr std::array kKeysOfAlgebraic = {
    Key{"of", "text", "the matrix whose eigenvalue l is"},
    Key{"near", "[number, number]", "the real and imaginary part of l", kRequired},
    Key{"polynomial", "[text]", "of which l is a root: fractions, the constant first", kRequired},
    Key{"terms", "[algebraic term]", "c z z*", kRequired}};

constexpr std::array kKeysOfTerm = {
    Key{"block", "text", "inequality and point", kRequired},
    Key{"vector", "[[text]]", "Z, z = Z (1, l, ...)'", kRequired},
    Key{"weight", "[text]", "of 1, l + m and l m in c, m the conjugate of l", kRequired},
    Key{"step", "whole", "of a chain of rational multipliers; 1 when absent"}};

constexpr std::array kKeysOfSumOfSquares = {
    Key{"name", "text", "of the inequality", kRequired}, Key{"variables", "[text]", "", kRequired},
    Key{"squares", "[square]", "times z'Qz", kRequired},
    Key{"free", "[free term]", "times a polynomial, of equations under 'where'"}};

constexpr std::array kKeysOfSquare = {
    Key{"times", "whole", "0: 1; k: the k-th polynomial that is >= 0", kRequired},
    Key{"basis", "[text]", "z, polynomials times rows of the inequality", kRequired},
    Key{"gram", "[[text]]", "Q, fractions: the lower triangle", kRequired}};

constexpr std::array kKeysOfFreeTerm = {
    Key{"times", "whole", "k: the k-th polynomial that is 0", kRequired},
    Key{"polynomial", "text", "", kRequired}};

constexpr std::array kKeysOfRefinement = {
    Key{"before", "number", "", kRequired}, Key{"after", "number | nothing", "", kRequired},
    Key{"kept", "truth", "", kRequired}, Key{"cause", "text", "", kRequired}};

constexpr std::array kKeysOfSearch = {
    Key{"figure", "text", "what was searched", kRequired},
    Key{"value", "number | nothing", "of the figure", kRequired},
    Key{"error", "number | nothing", "of the value, of a figure of runs"},
    Key{"beyond", "number | nothing", "the nearest value that is infeasible", kRequired},
    Key{"open", "[number]", "undecided values", kRequired},
    Key{"breaks", "[number]", "infeasible values inside", kRequired},
    Key{"over", "[text]", "scalars that were optimised", kRequired},
    Key{"at_end", "[text]", "those at an end of their range"},
    Key{"evaluations", "whole", "", kRequired},
    Key{"feasible", "whole", "", kRequired},
    Key{"finished", "truth", "", kRequired},
    Key{"joint_refinement", "refinement"},
    Key{"certificate", "certificate", "at 'beyond'"}};

constexpr std::array kKeysOfSolver = {Key{"status", "text", "", kRequired},
                                      Key{"cause", "text", "", kRequired},
                                      Key{"message", "text", "", kRequired},
                                      Key{"iterations", "whole", "", kRequired},
                                      Key{"relative_gap", "number", "", kRequired},
                                      Key{"primal_infeasibility", "number", "", kRequired},
                                      Key{"dual_infeasibility", "number", "", kRequired},
                                      Key{"precision", "text", "", kRequired}};

constexpr std::array kKeysOfStatement = {Key{"method", "text", "its name", kRequired},
                                         Key{"method_text", "text", "", kRequired},
                                         Key{"problem_file", "text", "", kRequired},
                                         Key{"problem_text", "text", "", kRequired},
                                         Key{"set", "{text}", "values that the command line gave"},
                                         Key{"files", "[file]", "what was read besides"},
                                         Key{"sha256", "text", "of both texts", kRequired}};

constexpr std::array kKeysOfProof = {Key{"version", "whole", "of the hash", kRequired},
                                     Key{"sha256", "text", "of statement and results", kRequired}};

constexpr std::array kKeysOfFile = {
    Key{"file", "text", "relative to the problem", kRequired}, Key{"sha256", "text", "", kRequired},
    Key{"text", "text", "of a problem"}, Key{"matrix", "row or rows", "of a file with one matrix"},
    Key{"matrices", "{row or rows}", "of a file with several"}};

const Level kDocumentLevel = {"gain file", "A gain file of gainsmith", kKeysOfDocument};
const Level kGainFunctionLevel = {"gain function", "A gain that is a function",
                                  kKeysOfGainFunction};
const Level kMarginLevel = {"margin", "How well an inequality holds", kKeysOfMargin};
const Level kBoundLevel = {"bound", "A bound on a gain", kKeysOfBound};
const Level kCertificateLevel = {"certificate", "The certificate of a no", kKeysOfCertificate};
const Level kAlgebraicLevel = {"algebraic", "Multipliers in fractions", kKeysOfAlgebraic};
const Level kTermLevel = {"algebraic term", "A part of a multiplier", kKeysOfTerm};
const Level kSumOfSquaresLevel = {"sum of squares", "An inequality as a sum of squares",
                                  kKeysOfSumOfSquares};
const Level kSquareLevel = {"square", "Squares with one multiplier", kKeysOfSquare};
const Level kFreeTermLevel = {"free term", "A term of the multiplier of an equation",
                              kKeysOfFreeTerm};
const Level kRefinementLevel = {"refinement", "Scalars and unknowns moved together",
                                kKeysOfRefinement};
const Level kSearchLevel = {"search", "How a search ended", kKeysOfSearch};
const Level kSolverLevel = {"solver", "What the solver says", kKeysOfSolver};
const Level kStatementLevel = {"statement", "The problem that was solved", kKeysOfStatement};
const Level kProofLevel = {"proof", "What shows that nothing was edited", kKeysOfProof};
const Level kFileLevel = {"file", "A file that was read", kKeysOfFile};

}  // namespace

std::span<const Level* const> gain_file_levels() {
  static constexpr std::array kLevels = {
      &kDocumentLevel,    &kGainFunctionLevel, &kMarginLevel, &kBoundLevel,
      &kCertificateLevel, &kRefinementLevel,   &kSearchLevel, &kSolverLevel,
      &kStatementLevel,   &kProofLevel,        &kFileLevel,   &kAlgebraicLevel,
      &kTermLevel,        &kSumOfSquaresLevel, &kSquareLevel, &kFreeTermLevel};
  return kLevels;
}

std::span<const NamedForm> gain_file_forms() {
  static constexpr std::array kNamedForms = {NamedForm{"rows", "number | [[number]]"},
                                             NamedForm{"row or rows", "[number]+ | [[number]+]+"}};
  return kNamedForms;
}

}  // namespace gainsmith::io
