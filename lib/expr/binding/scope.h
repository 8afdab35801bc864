// The names that an expression may use, and what they refer to.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "expr/program/program.h"
#include "expr/text/ast.h"
#include "expr/text/parser.h"

namespace gainsmith::expr {

/// A named matrix that a program takes as input. A known one (plant data, parameters) has a value
/// beforehand, so that functions whose shape depends on it (orth, null) can be bound.
struct Symbol {
  Shape shape;
  bool known = false;
  bool moves = false;  ///< a state, the time, noise: another value at another time of a run
  bool whole = false;  ///< a mode: a whole number, which may pick a member of a family
};

/// "name: expression" or "name(a, b): expression" in `let`.
struct Definition {
  std::vector<std::string> parameters;
  Expression body;
  std::vector<Shape> shapes{};  ///< of the parameters; none: whatever the body takes
};

/// What binding asks of the values of known symbols.
/// The only values that binding may depend on: they decide shapes and constants of programs, and
/// must be the same whenever the program is used.
class KnownValues {
 public:
  virtual ~KnownValues() = default;
  /// The value of a 1 x 1 program over known symbols.
  virtual double number(const Program& program) const = 0;
  /// The number of singular values above tolerance * the largest one; without a tolerance above
  /// rounding.
  virtual int rank(const Program& matrix, const Program* tolerance) const = 0;
  /// Exponents of two of the units in which A, n x n, and C, p x n, are near 1
  /// (numerics/balance.h).
  virtual std::vector<int> units(const Program& A, const Program& C) const = 0;
  /// The elements of a gain, row by row (numerics/output_gain.h).
  virtual std::vector<double> output_gain(const Program& A, const Program& B, const Program& C,
                                          bool discrete) const = 0;
};

/// "derivative(P)": under this name a scope has the derivative of a function, where it has one.
inline std::string derivative_name(const std::string& function) {
  return "derivative(" + function + ")";
}

inline bool is_derivative(const std::string& function) {
  return function.starts_with("derivative(");
}

/// "count(sample)": under this name a scope has a number that belongs to an event.
inline std::string event_number(const std::string& what, const std::string& event) {
  return what + "(" + event + ")";
}

/// "rate(x)": under this name a scope has the definition of the derivative of a symbol along flows;
/// "frozen(x)": of a number that is positive where the symbol rests nevertheless.
inline std::string rate_name(const std::string& symbol) { return "rate(" + symbol + ")"; }
inline std::string frozen_name(const std::string& symbol) { return "frozen(" + symbol + ")"; }

/// The ranges of the indices of a family.
using Ranges = std::vector<std::pair<int, int>>;

/// "P_2", "P_1_3": under these names a scope has the members P(2), P(1, 3) of a family.
std::string member_name(const std::string& family, const std::vector<int>& indices);

/// A scope is a value: an inner one is a copy with more names. A parameter hides all else; of a
/// name with several meanings the symbol comes first, then the definition, and the dimension last.
struct Scope {
  std::map<std::string, int> dimensions;  ///< n, p, ...
  std::map<std::string, Symbol> symbols;
  std::map<std::string, Definition> definitions;  ///< in any order; cycles are found when bound
  /// Functions of a number that are given later (link() in rewrite.h), with the shape of their
  /// values: unknown functions, gains that are functions.
  std::map<std::string, Shape> functions;
  /// Names with indices: P(2) is the symbol or function P_2.
  std::map<std::string, Ranges> families;
  std::shared_ptr<const KnownValues> known;  ///< none: nothing is known beforehand
  /// The symbol that is the time, along which a flow_map moves it; empty: none is.
  std::string time{};
  /// Symbols whose past is not kept, so that no flow_map can have them in its rate, with what to
  /// say of them.
  std::map<std::string, std::string> without_past{};
  /// The names that texts read, of all scopes that are copies of one; none: they are not noted.
  std::shared_ptr<std::set<std::string>> read{};

  /// All names, for suggestions.
  std::vector<std::string> names() const;
};

}  // namespace gainsmith::expr
