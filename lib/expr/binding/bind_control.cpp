// Functions of control that are made of operations, or represent one: ranks and subspaces,
// eigenvalues of symmetric matrices, observability, sampling, and the equations of Lyapunov and
// Riccati.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/emitter.h"

namespace gainsmith::expr {

namespace {

/// The columns of M above each other.
int stacked(const Emitter& make, int m) {
  std::vector<int> columns;
  const Shape from = make.shape(m);
  for (int j = 0; j < from.cols; ++j) columns.push_back(make.part(m, 0, from.rows, j, j + 1));
  return make.blocks(std::move(columns), 1);
}

/// The n x n matrix whose columns are stacked in `v`.
int unstacked(const Emitter& make, int v, int n) {
  std::vector<int> columns;
  for (int j = 0; j < n; ++j) columns.push_back(make.part(v, j * n, (j + 1) * n, 0, 1));
  return make.blocks(std::move(columns), n);
}

/// n x n blocks entry(i, j).
template <class Entry>
int square_of_blocks(const Emitter& make, int n, const Entry& entry) {
  std::vector<int> entries;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) entries.push_back(entry(i, j));
  return make.blocks(std::move(entries), n);
}

/// X -> A X + X A' on the columns of X above each other: blocks A_ij I, and A on the diagonal.
int continuous_operator(const Emitter& make, int a) {
  const int n = make.shape(a).rows;
  return square_of_blocks(make, n, [&](int i, int j) {
    const int multiple = make.identity(make.element(a, i, j), n);
    return i == j ? make.add(multiple, a) : multiple;
  });
}

/// X -> A X A' - X: blocks A_ij A, less I on the diagonal.
int discrete_operator(const Emitter& make, int a) {
  const int n = make.shape(a).rows;
  const int one = make.identity(n);
  return square_of_blocks(make, n, [&](int i, int j) {
    const int multiple = make.scale(make.element(a, i, j), a);
    return i == j ? make.subtract(multiple, one) : multiple;
  });
}

}  // namespace

/// What is decided while a text is bound may depend on known symbols alone.
Program Binder::known_program(const Expression& expression, const Node& node, int at,
                              std::string_view why) {
  Program program = extract(at);
  const auto refuse = [&](const std::string& name) {
    fail(expression, node,
         std::string(why) + " must not depend on '" + name +
             "', whose value is not known beforehand");
  };
  for (const Input& input : program.inputs)
    if (const auto symbol = scope_.symbols.find(input.name);
        !scope_.known || symbol == scope_.symbols.end() || !symbol->second.known)
      refuse(input.name);
  for (const Input& function : program.functions) refuse(function.name);
  if (!scope_.known) fail(expression, node, node.text + ": no value is known beforehand");
  return program;
}

/// The number of singular values above the tolerance times the largest one.
int Binder::known_rank(const Expression& expression, const Node& node, int at) {
  std::optional<Program> tolerance;
  if (node.children.size() == 2) {
    const Node& second = *node.children[1];
    const int tolerance_at = materialise(expression, second, bind(expression, second), {});
    tolerance = known_program(expression, second, tolerance_at, "the tolerance");
  }
  const Program matrix =
      known_program(expression, *node.children[0], at, "the argument of " + node.text);
  if (tolerance && scope_.known->number(*tolerance) < 0)
    fail(expression, *node.children[1], "the tolerance must not be negative");
  return scope_.known->rank(matrix, tolerance ? &*tolerance : nullptr);
}

Bound Binder::rank(const Expression& expression, const Node& node) {
  const int at = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  return {number(expression, node, std::to_string(known_rank(expression, node, at)))};
}

/// The argument C of a function of a plant: as many columns as A has rows.
int Binder::output_matrix(const Expression& expression, const Node& argument, int a) {
  const int c = sized(expression, argument, bind(expression, argument));
  if (shape(c).cols != shape(a).rows)
    materialise(expression, argument, {c}, {shape(c).rows, shape(a).rows});
  return c;
}

/// With as many digits as they need, so that they are exact in every number type.
int Binder::powers_of_two(const Emitter& make, const std::vector<int>& exponents, int sign) {
  std::vector<int> powers;
  for (const int one : exponents)
    powers.push_back(
        make.number(fmt::format("{:.{}e}", std::ldexp(1.0, sign * one), std::abs(one))));
  return make(Op::diagonal_matrix, {make.blocks(std::move(powers), 1)});
}

Bound Binder::units(const Expression& expression, const Node& node) {
  const int a = square_argument(expression, node, node.text);
  const Node& outputs = *node.children[1];
  const int c = output_matrix(expression, outputs, a);
  const std::string why = "the arguments of " + node.text;
  const Program A = known_program(expression, *node.children[0], a, why);
  const Program C = known_program(expression, outputs, c, why);
  const Emitter make(*this, expression, node);
  return {powers_of_two(make, scope_.known->units(A, C), 1)};
}

/// The rank r is decided now: orth has r columns and null n - r. The values of the columns are
/// computed whenever the program runs.
Bound Binder::basis(const Expression& expression, const Node& node, Op op) {
  const int at = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  const int rank = known_rank(expression, node, at);
  const Shape from = shape(at);
  const Shape result =
      op == Op::range_basis ? Shape{from.rows, rank} : Shape{from.cols, from.cols - rank};
  return {emit(expression, node, op, {at}, result)};
}

/// The number of columns is given, so that no rank is decided.
Bound Binder::complement(const Expression& expression, const Node& node) {
  const Node& argument = *node.children[0];
  const int at = sized(expression, argument, bind(expression, argument));
  const int count = required_whole_number(expression, *node.children[1], "the number of columns");
  const Shape from = shape(at);
  if (count < 0 || from.cols + count > from.rows)
    fail(expression, node,
         "complement: of " + describe(expression, argument, {at}) + " there are " +
             std::to_string(std::max(0, from.rows - from.cols)) + " columns, not " +
             std::to_string(count));
  return {emit(expression, node, Op::complement_basis, {at}, {from.rows, count})};
}

/// The quotient of the largest and the smallest singular value.
Bound Binder::condition_number(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const int m = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  const int values = make(Op::singular_values, {m});
  const int count = shape(values).rows;
  if (count == 0) fail(expression, node, "cond of an empty matrix");
  return {make(Op::divide, {make.element(values, 0), make.element(values, count - 1)}, {},
               "cond: a singular value is 0, so there is no finite quotient")};
}

/// Column by column, from the lower triangle: l = s/sqrt(s_1) of the first column s of what is
/// left, S - l l' without its first row and column is left then.
Bound Binder::cholesky(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  int left = square_argument(expression, node, node.text);
  const int n = shape(left).rows;
  if (n == 0) return {left};
  const std::string fault = "chol: the matrix is not positive definite";
  std::vector<int> columns;
  for (int j = 0; j < n; ++j) {
    const int size = n - j;
    const int column = make.part(left, 0, size, 0, 1);
    const int root = make(Op::sqrt, {make.element(column, 0)}, {}, fault);
    const int l = make(Op::divide, {column, root}, {}, fault);
    columns.push_back(j == 0 ? l : make.blocks({make.zeros({j, 1}), l}, 1));
    if (size == 1) break;
    const int rest = make.part(l, 1, size, 0, 1);
    left =
        make.subtract(make.part(left, 1, size, 1, size), make.multiply(rest, make.transpose(rest)));
  }
  return {make.blocks(std::move(columns), n)};
}

/// With the Frobenius norm c >= |M|: the singular values of M + c I and c I - M are eigenvalues,
/// the largest of them the one wanted but for c.
Bound Binder::extreme_eigenvalue(const Expression& expression, const Node& node, bool largest) {
  const Emitter make(*this, expression, node);
  const int m = square_argument(expression, node, node.text);
  const int size = shape(m).rows;
  if (size == 0) fail(expression, node, "an empty matrix has no eigenvalues");
  if (size == 1) return {m};
  std::vector<int> columns;
  for (int j = 0; j < size; ++j) columns.push_back(make.part(m, 0, size, j, j + 1));
  const int c = make(Op::norm, {make.blocks(columns, 1)});
  const int shift = make.identity(c, size);
  const int shifted = largest ? make.add(m, shift) : make.subtract(shift, m);
  const int first = make.element(make(Op::singular_values, {shifted}), 0);
  return {largest ? make.subtract(first, c) : make.subtract(c, first)};
}

/// Each block of rows is the one before times A.
Bound Binder::observability(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const int a = square_argument(expression, node, "obsv");
  const int c = sized(expression, *node.children[1], bind(expression, *node.children[1]));
  if (shape(c).cols != shape(a).rows)
    fail(expression, node,
         "obsv(A, C) needs C with " + std::to_string(shape(a).rows) + " columns, not " +
             describe(expression, *node.children[1], {c}));
  std::vector<int> rows = {c};
  for (int k = 1; k < shape(a).rows; ++k) rows.push_back(make.multiply(rows.back(), a));
  return {make.blocks(std::move(rows), 1)};
}

/// The second argument B of a function of (A, B): as many rows as A.
int Binder::input_matrix(const Expression& expression, const Node& node, int a) {
  const int b = sized(expression, *node.children[1], bind(expression, *node.children[1]));
  if (shape(b).rows != shape(a).rows)
    fail(expression, *node.children[1],
         node.text + " needs B with " + std::to_string(shape(a).rows) + " rows, not " +
             describe(expression, *node.children[1], {b}));
  return b;
}

Bound Binder::controllability(const Expression& expression, const Node& node) {
  const Emitter make(*this, expression, node);
  const int a = square_argument(expression, node, "ctrb");
  std::vector<int> columns = {input_matrix(expression, node, a)};
  for (int k = 1; k < shape(a).rows; ++k) columns.push_back(make.multiply(a, columns.back()));
  const auto count = static_cast<int>(columns.size());
  return {make.blocks(std::move(columns), count)};
}

/// The upper rows of expm([A, B; 0, 0]*T).
int Binder::sampled_matrices(const Emitter& make, int a, int b, int t) {
  const int n = make.shape(a).rows, m = make.shape(b).cols;
  const int whole = make.blocks({a, b, make.zeros({m, n}), make.zeros({m, m})}, 2);
  return make.part(make.exponential(whole, t), 0, n, 0, n + m);
}

/// c2d(A, B, T), or c2d(G, T) of a system.
Bound Binder::sampled(const Expression& expression, const Node& node) {
  if (node.children.size() == 2) return sampled_system(expression, node);
  const Emitter make(*this, expression, node);
  const int a = square_argument(expression, node, "c2d");
  const int b = input_matrix(expression, node, a);
  const Node& last = *node.children[2];
  return {sampled_matrices(make, a, b, materialise(expression, last, bind(expression, last), {}))};
}

/// The inverse of the operator, n^2 x n^2, on the columns of -Q.
Bound Binder::lyapunov(const Expression& expression, const Node& node, bool discrete) {
  const Emitter make(*this, expression, node);
  const int a = square_argument(expression, node, node.text);
  const int n = shape(a).rows;
  const Node& second = *node.children[1];
  const int q = materialise(expression, second, bind(expression, second), {n, n});
  if (n == 0) return {q};
  const int equations = discrete ? discrete_operator(make, a) : continuous_operator(make, a);
  const int inverse =
      make(Op::inverse, {equations}, {},
           discrete ? "dlyap: two eigenvalues of A have the product 1, as A*X*A' - X"
                    : "lyap: two eigenvalues of A have the sum 0, as A*X + X*A'");
  return {unstacked(make, make.multiply(inverse, make.negate(stacked(make, q))), n)};
}

/// The shortest decimals that read as the doubles which were found: the design has these very
/// numbers.
Bound Binder::output_gain(const Expression& expression, const Node& node, bool discrete) {
  const int a = square_argument(expression, node, node.text);
  const int b = input_matrix(expression, node, a);
  const Node& outputs = *node.children[2];
  const int c = output_matrix(expression, outputs, a);
  const std::string why = "the arguments of " + node.text;
  const Program A = known_program(expression, *node.children[0], a, why);
  const Program B = known_program(expression, *node.children[1], b, why);
  const Program C = known_program(expression, outputs, c, why);
  const Emitter make(*this, expression, node);
  const Shape of{shape(b).cols, shape(c).rows};
  if (of.size() == 0) return {make.zeros(of)};
  std::vector<int> elements;
  for (const double element : scope_.known->output_gain(A, B, C, discrete))
    elements.push_back(make.number(fmt::format("{}", element)));
  return {make.blocks(std::move(elements), of.cols)};
}

/// Continuous: A'X + X A - (X B + S) R^-1 (B'X + S') + Q = 0. Discrete: X = A'X A + Q less (A'X B +
/// S)(R + B'X B)^-1 (B'X A + S'). A: n x n, B: n x m, Q: n x n, R: m x m, S: n x m.
Bound Binder::riccati(const Expression& expression, const Node& node, Op op) {
  const int a = square_argument(expression, node, node.text);
  const int b = input_matrix(expression, node, a);
  const int n = shape(a).rows;
  const int m = shape(b).cols;
  if (n == 0 || m == 0) fail(expression, node, node.text + " needs a state and an input");
  const auto shaped = [&](std::size_t i, Shape wanted) {
    return materialise(expression, *node.children[i], bind(expression, *node.children[i]), wanted);
  };
  const int q = shaped(2, {n, n});
  const int r = shaped(3, {m, m});
  const int s =
      node.children.size() == 5 ? shaped(4, {n, m}) : emit(expression, node, Op::zeros, {}, {n, m});
  return {emit(expression, node, op, {a, b, q, r, s}, {n, n})};
}

}  // namespace gainsmith::expr
