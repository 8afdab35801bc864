// gainsmith as a library: semidefinite programs, gains from the text of a problem, gain files.
//
// This header needs the standard library alone and is installed as <gainsmith/gainsmith.h>. Several
// threads may call at once. A wrong input is an Error; std::bad_alloc passes.
//
// A program is given by numbers (solve) or by a text that also states data, unknowns, linear matrix
// inequalities and gains (synthesize). Numbers are double; decimals of texts are read exactly where
// a verdict rests on them. Results do not depend on the number of threads.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gainsmith::api {

/// "0.1.0".
std::string version();

/// The input is wrong. what() is "file:line:column: message"; a line or column that is not known is
/// 0.
class Error : public std::runtime_error {
 public:
  Error(const std::string& what, std::string in_file, int in_line, int in_column)
      : std::runtime_error(what), file(std::move(in_file)), line(in_line), column(in_column) {}

  std::string file;
  int line;
  int column;
};

/// A matrix, row by row.
struct Matrix {
  int rows = 0;
  int columns = 0;
  std::vector<double> elements;

  double operator()(int row, int column) const {
    return elements.at(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column));
  }
};

// Semidefinite programs in the standard form of SDPA:
//   primal:  minimise c'x      subject to  X = sum_i x_i F_i - F_0 >= 0
//   dual:    maximise F_0 . Y  subject to  F_i . Y = c_i (i = 1..m),  Y >= 0

struct Sdp {
  /// A symmetric block of X, size x size, or a diagonal one of `size` elements.
  struct Block {
    int size = 0;
    bool diagonal = false;
  };
  /// An element of F_matrix and the one across the diagonal; counted from 0, row <= column.
  struct Entry {
    int matrix = 0;  ///< 0..m
    int block = 0;
    int row = 0;
    int column = 0;
    double value = 0;
  };
  std::vector<Block> blocks;
  std::vector<double> costs;  ///< c
  std::vector<Entry> entries;
};

/// How far, in which arithmetic and on how many threads a program is solved.
struct SdpOptions {
  double tolerance = 1e-8;         ///< relative gap and DIMACS errors of "optimal"
  std::string precision = "auto";  ///< auto, double, quad, or a number of digits to 100
  unsigned threads = 1;            ///< 0: one a core; results do not depend on it
};

/// The words of `gainsmith solve`: see docs/sdp.md for what they promise.
enum class SdpStatus { optimal, primal_infeasible, dual_infeasible, undecided };

/// The best point, or a certificate with a status that says so. The measures are recomputed from
/// the program: relative_gap = (primal - dual) / (1 + |primal| + |dual|), and the six DIMACS errors
/// (Mittelmann 2003) in their order.
struct SdpSolution {
  SdpStatus status = SdpStatus::undecided;
  std::string message;    ///< why, when undecided
  std::vector<double> x;  ///< of an infeasible program the certificate
  std::vector<Matrix> X;  ///< a block each; of a diagonal one its diagonal, as a column
  std::vector<Matrix> Y;
  double primal_objective = 0;
  double dual_objective = 0;
  double relative_gap = 0;
  std::array<double, 6> dimacs_errors{};
  int iterations = 0;
  std::string precision;  ///< the widest arithmetic that was needed
};

/// Solves by a primal-dual interior-point method. Error for entries outside of their block, or of a
/// matrix beyond m, and for options that have no meaning.
SdpSolution solve(const Sdp& program, const SdpOptions& options = {});

// Gains.

/// yes: every inequality holds at the matrices as written; no: infeasible by a checked certificate
/// (docs/conventions.md).
enum class Verdict { yes, no, undecided };

/// One inequality at the decimals of the gain file; `reached` is relative, from 0 to 1.
struct Margin {
  std::string name;
  bool strict = true;
  bool holds = false;
  double reached = 0;
  double required = 0;
  std::string worst_point;  ///< "tau = 0"
};

/// What a gain file holds. Matrices are by the names of the problem; `objective` is empty where
/// nothing is minimised.
struct Gains {
  std::string problem;
  Verdict verdict = Verdict::undecided;
  std::string message;  ///< of the solver
  std::optional<double> objective;
  std::map<std::string, Matrix> gains;  ///< the constant ones
  std::map<std::string, Matrix> unknowns;
  std::map<std::string, Matrix> report;
  std::map<std::string, double> searched;  ///< scalars that a search set
  std::vector<Margin> margins;
  std::string text;  ///< of the gain file, as `gainsmith synth -o` writes it
};

/// The gains of a problem (docs/language.md); a method that it names is built in. `name` is its
/// file in messages, and data files are searched for beside it. `values` replace scalar data and
/// parameters. A problem that searches for the best figure of simulated runs is an Error: the
/// program does that.
Gains synthesize(const std::string& problem, const std::string& name,
                 const std::map<std::string, double>& values = {});

/// A gain file, checked for its keys and for the hash of its statement; what it says is not proved
/// again.
Gains read_gains(const std::string& text, const std::string& name);

}  // namespace gainsmith::api
