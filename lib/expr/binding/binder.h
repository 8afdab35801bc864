// Internal to expr: the state of one compilation.
//
// Binding walks a syntax tree and emits instructions. It resolves names by a Scope, gives every
// subexpression a shape, and expands definitions, sums over indices and functions that are made of
// operations. Its functions are in several files, named in the sections below.
//
// All of them take the expression with its text and the node that is bound, whose place messages
// name. They return indices of instructions (int), or a Bound. InputError for what does not fit.
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

#include "expr/binding/functions.h"
#include "expr/binding/scope.h"
#include "expr/program/assembly.h"

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
  /// By the kind of the node.
  Bound bind_kind(const Expression& expression, const Node& node);
  /// In this order: parameters, symbols, definitions, dimensions, I, pi, matrices of systems.
  Bound bind_name(const Expression& expression, const Node& node);
  /// The body with the arguments in place of the parameters. One without parameters is bound once.
  Bound bind_definition(const Expression& expression, const Node& node, const std::string& name,
                        std::vector<Bound> arguments);
  /// A + B or A - B of one shape; a number with a column counts for each element, with I or 0 for a
  /// matrix.
  Bound add(const Expression& expression, const Node& node, Op op, Bound a, Bound b);
  /// A B, s A, A s, and multiples of I.
  Bound multiply(const Expression& expression, const Node& node, Bound a, Bound b);
  /// A/s with a number s.
  Bound divide(const Expression& expression, const Node& node, Bound a, Bound b);
  /// A^k with a whole number k, of the inverse for k < 0; a^b of numbers.
  Bound power(const Expression& expression, const Node& node);
  Bound transpose(const Expression& expression, const Node& node, Bound a);

  // bind_elements.cpp: element by element.
  /// A.*B or A./B.
  Bound elementwise(const Expression& expression, const Node& node);
  /// A.^B; x.^k with a whole number k has a value for x < 0 too.
  Bound elementwise_power(const Expression& expression, const Node& node);
  /// Both sides in one shape: a number as a matrix of it.
  std::pair<int, int> fitted(const Expression& expression, const Node& node, Bound a, Bound b);
  /// The largest or smallest element of one vector.
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
  /// jacobian(e, x), size(e) x size(x); zeros where e does not depend on x.
  Bound jacobian(const Expression& expression, const Node& node);
  // bind_flow_map.cpp
  /// The state after the time d of x' = e(x, t), in the shape of x.
  Bound flow_map(const Expression& expression, const Node& node);
  /// InputError where the rate reads what has no past that is kept.
  void require_past(const Expression& expression, const Node& node,
                    const std::vector<int>& outside) const;
  // bind_rate.cpp
  /// v' along flows, of a number or a column v.
  Bound rate(const Expression& expression, const Node& node);
  /// By the instruction of a symbol that flows, that of its rate; 0 where the symbol is frozen.
  std::map<int, int> rates_of(const Expression& expression, const Node& node, int value);
  /// sum_k dv/dx_k f_k with the rates f_k, as the derivative by one number.
  Bound derivative_along(const Expression& expression, const Node& node, int value,
                         const std::map<int, int>& rates);

  // bind_extremum.cpp
  /// maximum(f, x in [a, b], ...) or minimum, 1 x 1: an estimate by a search.
  Bound extremum(const Expression& expression, const Node& node, bool largest);
  /// The ends of a box in one shape.
  std::pair<int, int> ends_of_box(const Expression& expression, const Node& box);
  void refuse_moving(const Expression& expression, const Node& node,
                     const std::vector<int>& operands) const;

  /// InputError for a body with a call of an unknown, or with another search.
  void refuse_inside(const Expression& expression, const Node& node, const Body& body) const;

  /// Whether it is the written number 0, which takes its shape from its place.
  bool is_zero(Bound value) const;
  /// InputError with the nearest name, or with what to write for a word of another language.
  [[noreturn]] void unknown_name(const Expression& expression, const Node& node) const;

  // bind_index.cpp: parts of matrices.
  /// Part of `base` by the children of the node from `first` on.
  Bound index(const Expression& expression, const Node& node, Bound base, std::size_t first);
  /// The places that an index of `whole` names, from 0.
  std::pair<int, int> index_range(const Expression& expression, const Node& whole, const Node& node,
                                  int size);
  /// Of numbers, dimensions, parameters, + - * and rank(M); none where it is not known beforehand.
  std::optional<int> whole_number(const Expression& expression, const Node& node);
  /// Of an index, in which `end` is the last one.
  std::optional<int> whole_index(const Expression& expression, const Node& node, int end);
  /// The same of an instruction.
  std::optional<int> whole_value(int at) const;

  // bind_families.cpp: names and sums with indices.
  /// "P_2" of P(2), P(i); nothing when the node is no member of a family.
  std::optional<std::string> member(const Expression& expression, const Node& node);
  /// P(q) with a mode q, or whole numbers over modes: nothing without one.
  std::optional<Bound> member_of_mode(const Expression& expression, const Node& node);
  /// Whether it is a mode, or a sum, difference or product of modes and whole numbers.
  bool is_over_modes(const Node& node) const;
  /// P(i)(s) of a family of functions, or nothing.
  std::optional<Bound> bind_member_call(const Expression& expression, const Node& node);
  /// sum(i in a..b, M), or sum(M) of all elements; 0 where the indices have no values.
  Bound sum(const Expression& expression, const Node& node);
  Bound sum_of_elements(const Expression& expression, const Node& node);
  void for_indices(const Expression& expression, const Node& node,
                   const std::function<void(const Bound&)>& take);
  std::vector<int> parts(const Expression& expression, const Node& node);
  Bound concatenated(const Expression& expression, const Node& node, bool side_by_side);
  /// A (x) B of shapes p x q and r x s, pr x qs.
  Bound kronecker(const Expression& expression, const Node& node);
  /// Whether a chain of comparisons of whole numbers is true.
  bool holds(const Expression& expression, const Node& comparison);
  /// The ends of a range, at most 10^9 in size and 100,000 values.
  std::pair<int, int> range_of(const Expression& expression, const Node& low, const Node& high);
  /// InputError that says what the number is of.
  int required_whole_number(const Expression& expression, const Node& node,
                            const std::string& what);

  // bind_blocks.cpp: block matrices.
  Bound bind_block(const Expression& expression, const Node& node);
  /// The block matrix of entries that fit, row by row.
  int assemble(const Expression& expression, const Node& node, std::vector<int> entries,
               int columns, const std::vector<int>& heights, const std::vector<int>& widths);

  // bind_calls.cpp: functions.
  Bound bind_call(const Expression& expression, const Node& node);
  std::optional<Node> of_event(const Node& node) const;
  /// A call of a function that is linked later, at a number.
  Bound bind_given_function(const Expression& expression, const Node& node, const std::string& name,
                            const Node& argument, Shape shape);
  /// derivative(P)(s), or nothing when the node is something else.
  std::optional<Bound> bind_derivative(const Expression& expression, const Node& node);
  /// A function that is a text of the table, with the arguments for its parameters.
  Bound bind_written(const Expression& expression, const Node& node, const Written& written);
  /// A function that a method of the binder makes, as its row in the table says.
  Bound bind_composed(const Expression& expression, const Node& node, Composed function);
  /// A function that is one operation.
  Bound bind_operation(const Expression& expression, const Node& node, const Function& function,
                       Op op);
  /// He(M) = M + M'.
  Bound symmetric(const Expression& expression, const Node& node);
  /// max(a, b, ...) and min, element by element.
  Bound fold_minmax(const Expression& expression, const Node& node, Op op);
  /// zeros, ones and eye of given sizes.
  Bound constant_matrix(const Expression& expression, const Node& node, Composed function);
  /// diag(v) of a vector, or the diagonal of a matrix.
  Bound diagonal(const Expression& expression, const Node& node);
  Bound block_diagonal(const Expression& expression, const Node& node);
  /// T_k(s) on [low, high], k from 0 to 100.
  Bound chebyshev(const Expression& expression, const Node& node);
  // bind_control.cpp
  /// orth(M) or null(M): orthonormal columns, as many as the rank at the known values says.
  Bound basis(const Expression& expression, const Node& node, Op op);
  /// The rank as a number.
  Bound rank(const Expression& expression, const Node& node);
  /// diag(2^(sign exponent)).
  static int powers_of_two(const Emitter& make, const std::vector<int>& exponents, int sign);
  /// Diagonal of powers of 2, n x n, of the units of the states (KnownValues::units).
  Bound units(const Expression& expression, const Node& node);
  /// Of the instruction `at`, the first argument of f(M, tol).
  int known_rank(const Expression& expression, const Node& node, int at);
  /// complement(V, k): k orthonormal columns orthogonal to those of V, n x m, m + k <= n.
  Bound complement(const Expression& expression, const Node& node);
  /// L with L L' = S, lower triangular.
  Bound cholesky(const Expression& expression, const Node& node);
  /// sigma_1/sigma_n.
  Bound condition_number(const Expression& expression, const Node& node);
  /// lambda_max or lambda_min of a symmetric matrix.
  Bound extreme_eigenvalue(const Expression& expression, const Node& node, bool largest);
  /// [C; C A; ...; C A^(n-1)], np x n.
  Bound observability(const Expression& expression, const Node& node);
  /// [B, A B, ..., A^(n-1) B], n x nm.
  Bound controllability(const Expression& expression, const Node& node);
  int output_matrix(const Expression& expression, const Node& argument, int a);
  int input_matrix(const Expression& expression, const Node& node, int a);
  /// [Ad, Bd] of the pair (A, B) over the time t.
  static int sampled_matrices(const Emitter& make, int a, int b, int t);
  /// c2d: [Ad, Bd] of (A, B) over a time, or a sampled system.
  Bound sampled(const Expression& expression, const Node& node);
  /// X of A X + X A' + Q = 0, or of A X A' - X + Q = 0 (`discrete`).
  Bound lyapunov(const Expression& expression, const Node& node, bool discrete);
  /// K, m x p, of numbers that are found beforehand (KnownValues::output_gain).
  Bound output_gain(const Expression& expression, const Node& node, bool discrete);
  /// X of a Riccati equation, n x n, with weights Q, R and S; S is 0 where it is not given.
  Bound riccati(const Expression& expression, const Node& node, Op op);
  // bind_tables.cpp
  Bound interpolated(const Expression& expression, const Node& node);
  /// InputError where one of the steps x_{k+1} - x_k is not positive.
  void require_rising(const Expression& expression, const Node& node, int steps);
  // bind_where.cpp
  Bound where(const Expression& expression, const Node& node);
  Bound chosen(const Expression& expression, const Node& node, const Node& condition, Bound yes,
               Bound no);
  Bound compared(const Expression& expression, const Node& node, const Node& chain, std::size_t k,
                 Bound yes, Bound no);
  std::optional<double> written_number(int at) const;
  /// `yes` where the difference is > 0 (strict) or >= 0, `no` elsewhere, element by element.
  Bound branch(const Expression& expression, const Node& node, int difference, bool strict,
               Bound yes, Bound no);
  // bind_systems.cpp: linear systems.
  [[noreturn]] void refuse_system(const Expression& expression, const Node& node) const;
  Bound as_system(const Expression& expression, const Node& node, Bound value, int size = 0);
  /// "G.A", or nothing when G is no system.
  std::optional<Bound> part_of_name(const Expression& expression, const Node& node);
  /// A, B, C or D of a system.
  Bound part_of_system(const Expression& expression, const Node& node, Bound system, char part);
  /// ss(A, B, C, D), or with a sampling time.
  Bound state_space(const Expression& expression, const Node& node);
  /// tf(num, den): the coefficients from the highest power on.
  Bound transfer_function(const Expression& expression, const Node& node);
  /// series, parallel or append of all arguments.
  Bound joined(const Expression& expression, const Node& node, Composed how);
  Bound pair_of_systems(const Expression& expression, const Node& node, Composed how, Bound first,
                        Bound second);
  /// G + H or G - H: parallel systems.
  Bound sum_of_systems(const Expression& expression, const Node& node, Bound a, Bound b);
  Bound divided_system(const Expression& expression, const Node& node, Bound system);
  /// G (I + K G)^-1; K is I where it is not given.
  Bound feedback(const Expression& expression, const Node& node);
  /// lft(P, K): u = K y closed around the last outputs and inputs of P.
  Bound linear_fraction(const Expression& expression, const Node& node);
  /// augw(G, W1, W2, W3): the plant of mixed sensitivity, with inputs [w; u], e = w - G u and
  /// outputs W1 e, W2 u, W3 G u, e; weights may be left out.
  Bound augmented(const Expression& expression, const Node& node);
  /// exp(-s T) by an all-pass of order n, 0 to 10.
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
  /// minreal(G), or with a tolerance: without states that inputs do not reach or outputs do not
  /// see.
  Bound minimal_realization(const Expression& expression, const Node& node);
  struct ToSample {
    SystemParts of;
    int states;
    int time;
  };
  ToSample to_sample(const Expression& expression, const Node& node, const Emitter& make);
  /// c2d(G, T) of an input that is held.
  Bound sampled_system(const Expression& expression, const Node& node);
  /// tustin(G, T).
  Bound bilinear(const Expression& expression, const Node& node);
  // bind_place.cpp
  struct Pole {
    double value, turn;            ///< its parts, turn >= 0
    int real;                      ///< the instructions of both
    std::optional<int> imaginary;  ///< none: a real pole
  };
  /// n poles as those on and above the real axis.
  std::vector<Pole> poles_of(const Expression& expression, const Node& node, int n);
  /// K, m x n, such that A - B K has the poles.
  Bound placed(const Expression& expression, const Node& node);
  // bind_gramian.cpp
  /// The Gramian, n x n, of a hybrid system over a window of flows (bind_gramian.cpp).
  Bound gramian(const Expression& expression, const Node& node, bool backward);
  // bind_projections.cpp
  /// The nearest point of a polytope, an ellipsoid or an affine set in a metric.
  Bound projection(const Expression& expression, const Node& node, const Function& function, Op op);
  /// The nearest point of {x: c(x) <= 0} with convex functions c.
  Bound convex_projection(const Expression& expression, const Node& node);

  /// The value, a number filled into the shape that is wanted.
  int same_shape(const Expression& expression, const Node& node, Bound value, Shape shape);
  /// The first argument; InputError where it is not square.
  int square_argument(const Expression& expression, const Node& node, std::string_view function);
  [[noreturn]] void not_square(const Expression& expression, const Node& argument, Bound value,
                               std::string_view function) const;
  /// The program of a value, all of whose inputs are known beforehand.
  Program known_program(const Expression& expression, const Node& node, int at,
                        std::string_view why);

  /// Adds an instruction at the place of the node. InputError for more than 10^7 elements.
  int emit(const Expression& expression, const Node& node, Op op, std::vector<int> operands,
           Shape shape, Attributes attributes = {}, std::string text = "",
           std::shared_ptr<const Program> body = nullptr);
  /// The shape that the operation's rule gives, none when the operands do not fit.
  std::optional<Shape> shape_of(Op op, const std::vector<int>& operands,
                                const Attributes& attributes = {}) const;
  /// A decimal as it is written, 1 x 1.
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
