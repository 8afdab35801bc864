// Internal to expr: the state of one compilation.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expr/assembly.h"
#include "expr/functions.h"
#include "expr/scope.h"

namespace gainsmith::expr {

class Emitter;

/// The value of a subexpression: an instruction or, when `identity`, the instruction's 1 x 1 value
/// times an identity whose size is not known yet. A system x' = A x + B u, y = C x + D u, sampled
/// x+ = ... with a `step`, is the matrix [A, B; C, D] with the number of its states.
struct Bound {
  int at = -1;
  bool identity = false;
  int states = -1;  ///< of a system; -1: of none
  int step = -1;    ///< the instruction of its sampling time; -1: continuous, or without states

  bool is_system() const { return states >= 0; }
};

/// What is said of != anywhere else.
inline constexpr const char* kNotEqual =
    "'!=' compares indices only, as in forall: [i in 1..N, j in 1..N, i != j]";

/// The last index, within an index.
inline constexpr std::string_view kEnd = "end";

/// Comparison k of a chain: its larger side and then the smaller one; of an equation as written.
Node ordered_pair(const Node& chain, std::size_t k);

class Binder {
 public:
  explicit Binder(const Scope& scope) : scope_(scope) {}

  /// A matrix or a multiple of I; a system is refused.
  Bound bind(const Expression& expression, const Node& node);
  /// A system too.
  Bound bind_value(const Expression& expression, const Node& node);
  /// A system; a matrix is one without states.
  Bound bind_system(const Expression& expression, const Node& node);
  /// Gives a multiple of I or a zero the shape `shape`; other values must have it already.
  int materialise(const Expression& expression, const Node& node, Bound value, Shape shape);
  /// The instruction of a value whose shape is known; `I` alone is an error.
  int sized(const Expression& expression, const Node& node, Bound value);
  Bound subtract(const Expression& expression, const Node& node, Bound a, Bound b);
  /// Of the sides of a pair (ordered_pair), the first minus the second.
  int difference(const Expression& expression, const Node& pair);
  /// [0, D; D', 0], which is >= 0 where D = 0 and nowhere else.
  int equation(const Expression& expression, const Node& node, int difference);
  /// The elements of a column or a row as a diagonal.
  int as_diagonal(const Expression& expression, const Node& node, int elements);

  Shape shape(int at) const { return assembly_.shape(at); }
  /// The matrices of a system, as instructions.
  struct SystemParts {
    int a, b, c, d;
  };
  static SystemParts parts_of(const Emitter& make, const Bound& system);
  /// The program that computes `at`, without the instructions that it does not need.
  Program extract(int at) const { return assembly_.extract(at); }

 private:
  friend class BlockBinding;
  friend class Emitter;
  friend std::pair<int, int> range_of(const Index& index, const Scope& scope);
  friend bool whole_condition(const Expression& expression, const Scope& scope);

  using Environment = std::map<std::string, Bound>;

  // binder.cpp: leaves and operators.
  Bound bind_kind(const Expression& expression, const Node& node);
  Bound bind_name(const Expression& expression, const Node& node);
  Bound bind_definition(const Expression& expression, const Node& node, const std::string& name,
                        std::vector<Bound> arguments);
  Bound add(const Expression& expression, const Node& node, Op op, Bound a, Bound b);
  Bound multiply(const Expression& expression, const Node& node, Bound a, Bound b);
  Bound divide(const Expression& expression, const Node& node, Bound a, Bound b);
  Bound power(const Expression& expression, const Node& node);
  Bound transpose(const Expression& expression, const Node& node, Bound a);

  // bind_elements.cpp: element by element.
  Bound elementwise(const Expression& expression, const Node& node);
  Bound elementwise_power(const Expression& expression, const Node& node);
  /// Both sides in one shape: a number as a matrix of it.
  std::pair<int, int> fitted(const Expression& expression, const Node& node, Bound a, Bound b);
  Bound extreme_element(const Expression& expression, const Node& node, Op op);
  Bound skew(const Expression& expression, const Node& node);
  Bound tangent(const Expression& expression, const Node& node);

  // bind_bodies.cpp: expressions as functions of a name.
  /// e of a call f(e, x, ...) or f(x, ..., e): `value` depends on the instruction `variable`, which
  /// represents the value of the instruction `point`.
  struct Varied {
    int value = -1;
    int variable = -1;
    int point = -1;
  };
  /// `value`, `variable`: the arguments e and x; `rate`: e has the shape of x.
  Varied varied(const Expression& expression, const Node& node, std::size_t value,
                std::size_t variable, bool rate);
  /// What depends on some instructions, as a program of its own.
  struct Body {
    Assembly assembly;
    int result = -1;
    std::vector<int> outside;  ///< what it uses besides: its inputs "operand k", ...
    std::set<Op> operations;
    std::string call;  ///< of an unknown or a gain
  };
  /// `inputs`: the instructions that vary and what the inputs in their place are called; `first`: k
  /// of the first instruction outside.
  Body body_of(int value, const std::vector<std::pair<int, std::string>>& inputs,
               std::size_t first) const;
  /// By instruction, up to `until` at least.
  std::vector<bool> depending_on(const std::vector<int>& variables, int until) const;
  // bind_jacobian.cpp
  Bound jacobian(const Expression& expression, const Node& node);
  // bind_flow_map.cpp
  Bound flow_map(const Expression& expression, const Node& node);
  void require_past(const Expression& expression, const Node& node,
                    const std::vector<int>& outside) const;
  // bind_rate.cpp
  Bound rate(const Expression& expression, const Node& node);
  std::map<int, int> rates_of(const Expression& expression, const Node& node, int value);
  Bound derivative_along(const Expression& expression, const Node& node, int value,
                         const std::map<int, int>& rates);

  // bind_extremum.cpp
  Bound extremum(const Expression& expression, const Node& node, bool largest);
  std::pair<int, int> ends_of_box(const Expression& expression, const Node& box);
  void refuse_moving(const Expression& expression, const Node& node,
                     const std::vector<int>& operands) const;

  void refuse_inside(const Expression& expression, const Node& node, const Body& body) const;

  bool is_zero(Bound value) const;
  [[noreturn]] void unknown_name(const Expression& expression, const Node& node) const;

  // bind_index.cpp: parts of matrices.
  Bound index(const Expression& expression, const Node& node, Bound base, std::size_t first);
  /// The places that an index of `whole` names, from 0.
  std::pair<int, int> index_range(const Expression& expression, const Node& whole, const Node& node,
                                  int size);
  std::optional<int> whole_number(const Expression& expression, const Node& node);
  /// Of an index, in which `end` is the last one.
  std::optional<int> whole_index(const Expression& expression, const Node& node, int end);
  std::optional<int> whole_value(int at) const;

  // bind_families.cpp: names and sums with indices.
  /// "P_2" of P(2), P(i); nothing when the node is no member of a family.
  std::optional<std::string> member(const Expression& expression, const Node& node);
  /// P(q) with a mode q, or whole numbers over modes: nothing without one.
  std::optional<Bound> member_of_mode(const Expression& expression, const Node& node);
  bool is_over_modes(const Node& node) const;
  /// P(i)(s) of a family of functions, or nothing.
  std::optional<Bound> bind_member_call(const Expression& expression, const Node& node);
  Bound sum(const Expression& expression, const Node& node);
  Bound sum_of_elements(const Expression& expression, const Node& node);
  void for_indices(const Expression& expression, const Node& node,
                   const std::function<void(const Bound&)>& take);
  std::vector<int> parts(const Expression& expression, const Node& node);
  Bound concatenated(const Expression& expression, const Node& node, bool side_by_side);
  Bound kronecker(const Expression& expression, const Node& node);
  bool holds(const Expression& expression, const Node& comparison);
  std::pair<int, int> range_of(const Expression& expression, const Node& low, const Node& high);
  int required_whole_number(const Expression& expression, const Node& node,
                            const std::string& what);

  // bind_blocks.cpp: block matrices.
  Bound bind_block(const Expression& expression, const Node& node);
  int assemble(const Expression& expression, const Node& node, std::vector<int> entries,
               int columns, const std::vector<int>& heights, const std::vector<int>& widths);

  // bind_calls.cpp: functions.
  Bound bind_call(const Expression& expression, const Node& node);
  std::optional<Node> of_event(const Node& node) const;
  Bound bind_given_function(const Expression& expression, const Node& node, const std::string& name,
                            const Node& argument, Shape shape);
  /// derivative(P)(s), or nothing when the node is something else.
  std::optional<Bound> bind_derivative(const Expression& expression, const Node& node);
  Bound bind_written(const Expression& expression, const Node& node, const Written& written);
  Bound bind_composed(const Expression& expression, const Node& node, Composed function);
  Bound bind_operation(const Expression& expression, const Node& node, const Function& function,
                       Op op);
  Bound symmetric(const Expression& expression, const Node& node);
  Bound fold_minmax(const Expression& expression, const Node& node, Op op);
  Bound constant_matrix(const Expression& expression, const Node& node, Composed function);
  Bound diagonal(const Expression& expression, const Node& node);
  Bound block_diagonal(const Expression& expression, const Node& node);
  Bound chebyshev(const Expression& expression, const Node& node);
  // bind_control.cpp
  Bound basis(const Expression& expression, const Node& node, Op op);
  Bound rank(const Expression& expression, const Node& node);
  /// The decimal of 2^exponent.
  static int power_of_two(const Emitter& make, int exponent);
  Bound units(const Expression& expression, const Node& node);
  /// Of the instruction `at`, the first argument of f(M, tol).
  int known_rank(const Expression& expression, const Node& node, int at);
  Bound complement(const Expression& expression, const Node& node);
  Bound cholesky(const Expression& expression, const Node& node);
  Bound condition_number(const Expression& expression, const Node& node);
  Bound extreme_eigenvalue(const Expression& expression, const Node& node, bool largest);
  Bound observability(const Expression& expression, const Node& node);
  Bound controllability(const Expression& expression, const Node& node);
  int output_matrix(const Expression& expression, const Node& argument, int a);
  int input_matrix(const Expression& expression, const Node& node, int a);
  /// [Ad, Bd] of the pair (A, B) over the time t.
  static int sampled_matrices(const Emitter& make, int a, int b, int t);
  Bound sampled(const Expression& expression, const Node& node);
  Bound lyapunov(const Expression& expression, const Node& node, bool discrete);
  Bound output_gain(const Expression& expression, const Node& node, bool discrete);
  Bound riccati(const Expression& expression, const Node& node, Op op);
  // bind_tables.cpp
  Bound interpolated(const Expression& expression, const Node& node);
  void require_rising(const Expression& expression, const Node& node, int steps);
  // bind_where.cpp
  Bound where(const Expression& expression, const Node& node);
  Bound chosen(const Expression& expression, const Node& node, const Node& condition, Bound yes,
               Bound no);
  Bound compared(const Expression& expression, const Node& node, const Node& chain, std::size_t k,
                 Bound yes, Bound no);
  std::optional<double> written_number(int at) const;
  Bound branch(const Expression& expression, const Node& node, int difference, bool strict,
               Bound yes, Bound no);
  // bind_systems.cpp: linear systems.
  [[noreturn]] void refuse_system(const Expression& expression, const Node& node) const;
  Bound as_system(const Expression& expression, const Node& node, Bound value, int size = 0);
  /// "G.A", or nothing when G is no system.
  std::optional<Bound> part_of_name(const Expression& expression, const Node& node);
  Bound part_of_system(const Expression& expression, const Node& node, Bound system, char part);
  Bound state_space(const Expression& expression, const Node& node);
  Bound transfer_function(const Expression& expression, const Node& node);
  Bound joined(const Expression& expression, const Node& node, Composed how);
  Bound pair_of_systems(const Expression& expression, const Node& node, Composed how, Bound first,
                        Bound second);
  Bound sum_of_systems(const Expression& expression, const Node& node, Bound a, Bound b);
  Bound divided_system(const Expression& expression, const Node& node, Bound system);
  Bound feedback(const Expression& expression, const Node& node);
  Bound linear_fraction(const Expression& expression, const Node& node);
  Bound augmented(const Expression& expression, const Node& node);
  Bound pade(const Expression& expression, const Node& node);
  // bind_realizations.cpp
  static Bound in_basis(const Emitter& make, const SystemParts& of, int basis);
  int reachable(const Expression& expression, const Node& node, const Emitter& make,
                std::pair<int, int> pair, int size, int tolerance);
  Bound in_near_units(const Expression& expression, const Node& node, const Emitter& make,
                      const Bound& system);
  bool is_same_function(const Expression& expression, const Node& node, const Emitter& make,
                        const Bound& one, const Bound& other);
  Bound reduced(const Expression& expression, const Node& node, const Emitter& make,
                const Bound& system, int tolerance);
  Bound minimal_realization(const Expression& expression, const Node& node);
  struct ToSample {
    SystemParts of;
    int states;
    int time;
  };
  ToSample to_sample(const Expression& expression, const Node& node, const Emitter& make);
  Bound sampled_system(const Expression& expression, const Node& node);
  Bound bilinear(const Expression& expression, const Node& node);
  // bind_place.cpp
  struct Pole {
    double value, turn;            ///< its parts, turn >= 0
    int real;                      ///< the instructions of both
    std::optional<int> imaginary;  ///< none: a real pole
  };
  std::vector<Pole> poles_of(const Expression& expression, const Node& node, int n);
  Bound placed(const Expression& expression, const Node& node);
  // bind_gramian.cpp
  Bound gramian(const Expression& expression, const Node& node, bool backward);
  // bind_projections.cpp
  Bound projection(const Expression& expression, const Node& node, const Function& function, Op op);
  Bound convex_projection(const Expression& expression, const Node& node);

  int same_shape(const Expression& expression, const Node& node, Bound value, Shape shape);
  int square_argument(const Expression& expression, const Node& node, std::string_view function);
  [[noreturn]] void not_square(const Expression& expression, const Node& argument, Bound value,
                               std::string_view function) const;
  /// The program of a value, all of whose inputs are known beforehand.
  Program known_program(const Expression& expression, const Node& node, int at,
                        std::string_view why);

  int emit(const Expression& expression, const Node& node, Op op, std::vector<int> operands,
           Shape shape, Attributes attributes = {}, std::string text = "",
           std::shared_ptr<const Program> body = nullptr);
  /// The shape that the operation's rule gives, none when the operands do not fit.
  std::optional<Shape> shape_of(Op op, const std::vector<int>& operands,
                                const Attributes& attributes = {}) const;
  int number(const Expression& expression, const Node& node, const std::string& text);
  [[noreturn]] void fail(const Expression& expression, const Node& node,
                         const std::string& message) const;
  std::string describe(const Expression& expression, const Node& node, Bound value) const;

  const Scope& scope_;
  Assembly assembly_;
  std::map<std::string, Bound> defined_;       ///< definitions without parameters, once bound
  std::vector<std::string> open_definitions_;  ///< being bound now, to find cycles
  int depth_ = 0;                              ///< of calls of bind()
  int steps_ = 0;                              ///< calls of bind() within definitions and sums
  int open_sums_ = 0;                          ///< over indices, being bound now
  int varied_ = 0;                             ///< parameters and definitions that vary
  int extrema_ = 0;                            ///< bound so far
  std::vector<int> ends_;                      ///< what `end` is in the indices being bound now
  Environment environment_;                    ///< parameters of the definition being bound
  std::string fault_;                          ///< of the text of the table being bound (Written)
};

}  // namespace gainsmith::expr
