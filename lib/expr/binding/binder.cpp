// Leaves and operators of the language, definitions, and the entries compile(), compile_system()
// and compile_relations() of compile.h.
#include "expr/binding/binder.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/number.h"
#include "expr/binding/compile.h"
#include "expr/text/work.h"

namespace gainsmith::expr {

std::vector<std::string> Scope::names() const {
  std::vector<std::string> all;
  for (const auto& [name, value] : symbols) all.push_back(name);
  for (const auto& [name, value] : definitions) all.push_back(name);
  for (const auto& [name, value] : functions) all.push_back(name);
  for (const auto& [name, value] : families) all.push_back(name);
  for (const auto& [name, value] : dimensions) all.push_back(name);
  return all;
}

void Binder::fail(const Expression& expression, const Node& node,
                  const std::string& message) const {
  throw InputError(expression.place(node), message);
}

std::string Binder::describe(const Expression& expression, const Node& node, Bound value) const {
  const std::string quoted = expression.quote(node);
  if (value.identity) return quoted + " (a multiple of I)";
  return quoted + " (" + to_string(shape(value.at)) + ")";
}

/// Roots and logarithms within a text of the table get its message (Written::fault).
int Binder::emit(const Expression& expression, const Node& node, Op op, std::vector<int> operands,
                 Shape shape, Attributes attributes, std::string text,
                 std::shared_ptr<const Program> body) {
  constexpr std::int64_t kMostElements = 10'000'000;
  if (std::int64_t{shape.rows} * shape.cols > kMostElements)
    fail(expression, node, "the " + to_string(op) + " is too large: " + to_string(shape));
  if (text.empty() && is_one_of(op, {Op::sqrt, Op::log})) text = fault_;
  return assembly_.add({op, std::move(operands), shape, attributes, std::move(text),
                        expression.text, node.begin, std::move(body)});
}

int Binder::number(const Expression& expression, const Node& node, const std::string& text) {
  return emit(expression, node, Op::constant, {}, {}, {}, text);
}

bool Binder::is_zero(Bound value) const {
  const Instruction& instruction = assembly_[value.at];
  return instruction.op == Op::constant && instruction.text != "pi" &&
         parse_decimal(instruction.text) == 0.0;
}

Bound Binder::bind(const Expression& expression, const Node& node) {
  const Bound value = bind_value(expression, node);
  if (value.is_system()) refuse_system(expression, node);
  return value;
}

Bound Binder::bind_value(const Expression& expression, const Node& node) {
  // Definitions and sums may build on each other in towers that no formula needs. Outside of them
  // an operation is written in the text.
  constexpr int kDeepest = 1000;
  constexpr int kMostSteps = 250'000;
  if (depth_ >= kDeepest) fail(expression, node, "the definitions are nested too deeply");
  if ((!open_definitions_.empty() || open_sums_ > 0) && ++steps_ > kMostSteps)
    fail(expression, node, "the definitions and sums expand to too many operations");
  ++depth_;
  const Bound value = bind_kind(expression, node);
  --depth_;
  return value;
}

Bound Binder::bind_kind(const Expression& expression, const Node& node) {
  const auto child = [&](std::size_t i) { return bind(expression, *node.children[i]); };
  const auto value = [&](std::size_t i) { return bind_value(expression, *node.children[i]); };
  switch (node.kind) {
    case NodeKind::number:
      return {number(expression, node, node.text)};
    case NodeKind::name:
      return bind_name(expression, node);
    case NodeKind::call:
      if (const auto derivative = bind_derivative(expression, node)) return *derivative;
      return bind_call(expression, node);
    case NodeKind::index:
      if (const auto derivative = bind_derivative(expression, node)) return *derivative;
      if (const auto member = bind_member_call(expression, node)) return *member;
      return index(expression, node, child(0), 1);
    case NodeKind::negate: {
      const Bound a = value(0);
      if (a.is_system())
        return pair_of_systems(expression, node, Composed::series, a,
                               {number(expression, node, "-1"), true});
      return {emit(expression, node, Op::negate, {a.at}, shape(a.at)), a.identity};
    }
    case NodeKind::transpose:
      return transpose(expression, node, child(0));
    case NodeKind::add:
    case NodeKind::subtract: {
      const Bound a = value(0);
      const Bound b = value(1);
      if (a.is_system() || b.is_system()) return sum_of_systems(expression, node, a, b);
      return add(expression, node, node.kind == NodeKind::add ? Op::add : Op::subtract, a, b);
    }
    case NodeKind::multiply: {
      const Bound a = value(0);
      const Bound b = value(1);
      if (a.is_system() || b.is_system())
        return pair_of_systems(expression, node, Composed::series, b, a);
      return multiply(expression, node, a, b);
    }
    case NodeKind::divide: {
      const Bound a = value(0);
      if (a.is_system()) return divided_system(expression, node, a);
      return divide(expression, node, a, child(1));
    }
    case NodeKind::power:
      return power(expression, node);
    case NodeKind::elementwise_multiply:
    case NodeKind::elementwise_divide:
      return elementwise(expression, node);
    case NodeKind::elementwise_power:
      return elementwise_power(expression, node);
    case NodeKind::block:
      return bind_block(expression, node);
    case NodeKind::range:
      fail(expression, node, "a range is allowed only in an index, such as x(1:2)");
    case NodeKind::each:
      fail(expression, node,
           "an index is allowed only first in sum, horzcat, vertcat and blkdiag, such as "
           "sum(i in 1..N, P(i))");
    case NodeKind::within:
      fail(expression, node,
           "a box is allowed only in maximum(f, x in [a, b]) and in minimum(...)");
    case NodeKind::mirror:
      fail(expression, node, "'*' alone is allowed only in a block");
    case NodeKind::compare:
      fail(expression, node,
           "a comparison is allowed only on its own or in where(...): where(t > 5 and t < 6, 1, 0) "
           "is 1 "
           "from 5 to 6");
    case NodeKind::conjunction:
    case NodeKind::disjunction:
    case NodeKind::negation:
      fail(expression, node, "'and', 'or' and 'not' join conditions: of events or in where(...)");
  }
  fail(expression, node, "unknown syntax");
}

Bound Binder::bind_name(const Expression& expression, const Node& node) {
  const std::string& name = node.text;
  if (const auto found = environment_.find(name); found != environment_.end()) return found->second;
  if (scope_.read) scope_.read->insert(name);
  if (const auto found = scope_.symbols.find(name); found != scope_.symbols.end()) {
    Instruction like;
    like.origin = expression.text;
    like.offset = node.begin;
    return {assembly_.add_input(name, found->second.shape, like)};
  }
  if (scope_.functions.contains(name))
    fail(expression, node, "'" + name + "' is a function: write " + name + "(s) with a number s");
  if (scope_.families.contains(name))
    fail(expression, node,
         "'" + name + "' is a family: write one of its members, " + name + "(1) or " + name +
             "(i) with an index i");
  if (scope_.definitions.contains(name)) return bind_definition(expression, node, name, {});
  if (const auto found = scope_.dimensions.find(name); found != scope_.dimensions.end())
    return {number(expression, node, std::to_string(found->second))};
  if (name == "I") return {number(expression, node, "1"), true};
  if (name == "pi") return {number(expression, node, "pi")};
  if (const auto part = part_of_name(expression, node)) return *part;
  if (const Function* function = find_function(name))
    fail(expression, node, "'" + name + "' is a function: write " + std::string(function->usage));
  unknown_name(expression, node);
}

/// The body sees the names of the whole scope and its own parameters, not those of the caller.
/// Cycles are found by the definitions that are open.
Bound Binder::bind_definition(const Expression& expression, const Node& node,
                              const std::string& name, std::vector<Bound> arguments) {
  const Definition& definition = scope_.definitions.at(name);
  if (arguments.size() != definition.parameters.size())
    fail(expression, node,
         "'" + name + "' takes " + std::to_string(definition.parameters.size()) +
             " arguments, not " + std::to_string(arguments.size()));
  for (std::size_t i = 0; i < definition.shapes.size(); ++i)
    if (!arguments[i].identity && shape(arguments[i].at) != definition.shapes[i])
      fail(expression, *node.children[i],
           "the argument " + definition.parameters[i] + " of '" + name + "' is " +
               to_string(definition.shapes[i]) + "; found " + to_string(shape(arguments[i].at)));
  if (arguments.empty())
    if (const auto found = defined_.find(name); found != defined_.end()) return found->second;
  if (std::find(open_definitions_.begin(), open_definitions_.end(), name) !=
      open_definitions_.end())
    fail(expression, node, "'" + name + "' is defined by itself");
  Environment inner;
  for (std::size_t i = 0; i < arguments.size(); ++i)
    inner.emplace(definition.parameters[i], arguments[i]);
  std::swap(environment_, inner);
  open_definitions_.push_back(name);
  const Bound value = bind_value(definition.body, *definition.body.root);
  open_definitions_.pop_back();
  std::swap(environment_, inner);
  if (arguments.empty()) defined_.emplace(name, value);
  return value;
}

int Binder::sized(const Expression& expression, const Node& node, Bound value) {
  if (value.identity)
    fail(expression, node,
         "the size of the identity in '" + expression.quote(node) +
             "' is not known here; write eye(n)");
  return value.at;
}

/// I and 0 get their size here: s I becomes s eye(n), and 0 becomes zeros(r, c).
int Binder::materialise(const Expression& expression, const Node& node, Bound value, Shape wanted) {
  if (value.identity) {
    if (!wanted.is_square())
      fail(expression, node,
           "'" + expression.quote(node) + "' is a multiple of I, but " + to_string(wanted) +
               " is wanted here");
    return emit(expression, node, Op::identity, {value.at}, wanted);
  }
  if (shape(value.at) == wanted) return value.at;
  if (is_zero(value)) return emit(expression, node, Op::zeros, {}, wanted);
  const Shape found = shape(value.at);
  const bool turned = found.rows == wanted.cols && found.cols == wanted.rows;
  fail(expression, node,
       describe(expression, node, value) + " has the wrong shape: expected " + to_string(wanted) +
           (turned && (found.rows == 1 || found.cols == 1)
                ? "; a column is written [a; b], a row [a, b]"
            : found.size() == 1 && wanted.is_square()
                ? "; a multiple of the identity is written " + expression.quote(node) + "*I"
            : wanted.size() == 1 && found.cols == 1 && node.kind == NodeKind::name
                ? "; the size of a column is norm(" + expression.quote(node) + "), an element " +
                      expression.quote(node) + "(1)"
                : ""));
}

Bound Binder::subtract(const Expression& expression, const Node& node, Bound a, Bound b) {
  return add(expression, node, Op::subtract, a, b);
}

Bound Binder::add(const Expression& expression, const Node& node, Op op, Bound a, Bound b) {
  const Node& left = *node.children[0];
  const Node& right = *node.children[1];
  if ((a.identity && (b.identity || is_zero(b))) || (b.identity && is_zero(a)))
    return {emit(expression, node, op, {a.at, b.at}, {}), true};
  const auto is_free = [&](Bound value) { return value.identity || is_zero(value); };
  if (is_free(a) && !b.identity) {
    const int first = materialise(expression, left, a, shape(b.at));
    return {emit(expression, node, op, {first, b.at}, shape(b.at))};
  }
  if (is_free(b) && !a.identity) {
    const int second = materialise(expression, right, b, shape(a.at));
    return {emit(expression, node, op, {a.at, second}, shape(a.at))};
  }
  const auto is_column = [&](Bound value) {
    return !value.identity && shape(value.at).cols == 1 && shape(value.at).rows > 1;
  };
  const auto is_number = [&](Bound value) {
    return !value.identity && shape(value.at).is_scalar();
  };
  if (is_number(a) && is_column(b)) a = {emit(expression, left, Op::fill, {a.at}, shape(b.at))};
  if (is_number(b) && is_column(a)) b = {emit(expression, right, Op::fill, {b.at}, shape(a.at))};
  if (shape(a.at) != shape(b.at)) {
    const bool scalar = shape(a.at).is_scalar() || shape(b.at).is_scalar();
    const auto is_vector = [&](Bound value) {
      return shape(value.at).size() > 1 && (shape(value.at).rows == 1 || shape(value.at).cols == 1);
    };
    fail(expression, node,
         "cannot " +
             std::string(node.kind == NodeKind::compare ? "compare "
                         : op == Op::add                ? "add "
                                                        : "subtract ") +
             describe(expression, left, a) + " and " + describe(expression, right, b) +
             (scalar && node.kind == NodeKind::compare && (is_vector(a) || is_vector(b))
                  ? "; elements are compared by min(x) >= a, max(x) <= b or abs(x) <= b"
              : scalar ? "; a multiple of the identity is written s*I"
                       : ""));
  }
  return {emit(expression, node, op, {a.at, b.at}, shape(a.at))};
}

/// A multiple of I stays one where the other factor is a number or a multiple of I.
Bound Binder::multiply(const Expression& expression, const Node& node, Bound a, Bound b) {
  const Shape left = shape(a.at);
  const Shape right = shape(b.at);
  if (a.identity || b.identity) {
    const Bound& other = a.identity ? b : a;
    const int factor = a.identity ? a.at : b.at;
    const bool stays_identity = other.identity || shape(other.at).is_scalar();
    const Op op = stays_identity ? Op::multiply : Op::scale;
    return {emit(expression, node, op, {factor, other.at}, shape(other.at)), stays_identity};
  }
  if (left.is_scalar() && !right.is_scalar())
    return {emit(expression, node, Op::scale, {a.at, b.at}, right)};
  if (right.is_scalar() && !left.is_scalar())
    return {emit(expression, node, Op::scale, {b.at, a.at}, left)};
  if (left.cols != right.rows)
    fail(expression, node,
         "cannot multiply " + describe(expression, *node.children[0], a) + " by " +
             describe(expression, *node.children[1], b) + ": " + std::to_string(left.cols) +
             " columns meet " + std::to_string(right.rows) + " rows" +
             (left == right ? "; element by element it is .*" : ""));
  return {emit(expression, node, Op::multiply, {a.at, b.at}, {left.rows, right.cols})};
}

Bound Binder::divide(const Expression& expression, const Node& node, Bound a, Bound b) {
  const Node& right = *node.children[1];
  if (!b.identity && !shape(b.at).is_scalar())
    fail(expression, node,
         "cannot divide by " + describe(expression, right, b) +
             ": only by a number; write inv(...)*" +
             (shape(a.at) == shape(b.at) || shape(a.at).is_scalar() ? ", or ./ for each element"
                                                                    : ""));
  const int divisor = sized(expression, right, b);
  return {emit(expression, node, Op::divide, {a.at, divisor}, shape(a.at)), a.identity};
}

Bound Binder::transpose(const Expression& expression, const Node& node, Bound a) {
  if (a.identity || shape(a.at).is_scalar()) return a;
  return {emit(expression, node, Op::transpose, {a.at}, {shape(a.at).cols, shape(a.at).rows})};
}

/// A^k with whole k is a product of k factors, or of the inverse for k < 0. Other exponents are of
/// numbers.
Bound Binder::power(const Expression& expression, const Node& node) {
  const Node& base_node = *node.children[0];
  const Node& exponent_node = *node.children[1];
  const Bound base = bind(expression, base_node);
  const Shape base_shape = shape(base.at);
  if (!base_shape.is_square())
    fail(expression, node,
         "cannot take a power of " + describe(expression, base_node, base) +
             ": it is not square; element by element it is .^");
  if (const auto exponent = whole_number(expression, exponent_node)) {
    int value = base.at;
    if (*exponent < 0) value = emit(expression, node, Op::inverse, {value}, base_shape);
    return {emit(expression, node, Op::power, {value}, base_shape, {std::abs(*exponent)}),
            base.identity};
  }
  const Bound exponent = bind(expression, exponent_node);
  if (!base_shape.is_scalar() || !shape(exponent.at).is_scalar())
    fail(expression, node,
         "a matrix takes only whole powers; for exp(A*t) write expm(A*t), for powers of the "
         "elements .^");
  return {emit(expression, node, Op::real_power,
               {base.at, sized(expression, exponent_node, exponent)}, {}),
          base.identity};
}

/// Symmetric, r + c rows for D of r x c. Its eigenvalues are +- the singular values of D, and 0.
int Binder::equation(const Expression& expression, const Node& node, int difference) {
  const auto [rows, columns] = shape(difference);
  const int transposed = sized(expression, node, transpose(expression, node, {difference}));
  const int above = emit(expression, node, Op::zeros, {}, {rows, rows});
  const int below = emit(expression, node, Op::zeros, {}, {columns, columns});
  return emit(expression, node, Op::blocks, {above, difference, transposed, below},
              {rows + columns, rows + columns}, {2});
}

int Binder::as_diagonal(const Expression& expression, const Node& node, int elements) {
  const auto size = static_cast<int>(shape(elements).size());
  return emit(expression, node, Op::diagonal_matrix, {elements}, {size, size});
}

Program compile(const Expression& expression, const Scope& scope, std::optional<Shape> expected) {
  count_bound();
  Binder binder(scope);
  const Node& root = *expression.root;
  const Bound value = binder.bind(expression, root);
  const int at = expected ? binder.materialise(expression, root, value, *expected)
                          : binder.sized(expression, root, value);
  return binder.extract(at);
}

CompiledSystem compile_system(const Expression& expression, const Scope& scope) {
  count_bound();
  Binder binder(scope);
  const Bound value = binder.bind_system(expression, *expression.root);
  CompiledSystem system{binder.extract(value.at), value.states, std::nullopt};
  if (value.step >= 0) system.step = binder.extract(value.step);
  return system;
}

namespace {

bool is_eigenvalues(const Node& node) {
  return node.kind == NodeKind::call && node.text == "eig" && node.children.size() == 1;
}

/// A side of eig(P) < 3 as one of P < 3*I.
/// A side of a comparison of eigenvalues as the side of a matrix inequality, for the message.
std::string of_matrices(const Expression& expression, const Node& side) {
  if (is_eigenvalues(side)) return expression.quote(*side.children[0]);
  const std::string text = expression.quote(side);
  if (text == "0") return text;
  const bool plain = side.kind == NodeKind::number || side.kind == NodeKind::name;
  return (plain ? text : "(" + text + ")") + "*I";
}

}  // namespace

/// Each comparison of the chain becomes large - small, all in one assembly, so that the sides in
/// the middle are bound once.
std::vector<CompiledRelation> compile_relations(const Expression& expression, const Scope& scope) {
  count_bound();
  const Node& root = *expression.root;
  if (root.kind != NodeKind::compare)
    throw InputError(expression.place(root),
                     "expected a comparison such as P > 0, found '" + expression.quote(root) + "'");
  Binder binder(scope);
  std::vector<Bound> sides;
  for (const NodePtr& child : root.children) sides.push_back(binder.bind(expression, *child));
  std::vector<CompiledRelation> relations;
  for (std::size_t i = 0; i < root.relations.size(); ++i) {
    const Relation relation = root.relations[i];
    const bool ascending = relation == Relation::less || relation == Relation::less_equal;
    const std::size_t small = ascending ? i : i + 1;
    const std::size_t large = ascending ? i + 1 : i;
    Node pair;
    pair.kind = NodeKind::compare;
    pair.begin = root.children[i]->begin;
    pair.end = root.children[i + 1]->end;
    pair.children = {root.children[large], root.children[small]};
    if (is_eigenvalues(*pair.children[0]) || is_eigenvalues(*pair.children[1]))
      throw InputError(expression.place(pair),
                       "eig has rows of two numbers; for a symmetric matrix write " +
                           of_matrices(expression, *pair.children[1]) + " < " +
                           of_matrices(expression, *pair.children[0]));
    const Bound difference = binder.subtract(expression, pair, sides[large], sides[small]);
    int at = binder.sized(expression, pair, difference);
    if (relation == Relation::not_equal) throw InputError(expression.place(pair), kNotEqual);
    if (relation == Relation::equal) {
      relations.push_back({binder.extract(binder.equation(expression, pair, at)), false, true});
      continue;
    }
    // A column or a row is no symmetric matrix: its elements are compared.
    if (const Shape of = binder.shape(at); !of.is_square() && (of.cols == 1 || of.rows == 1))
      at = binder.as_diagonal(expression, pair, at);
    if (!binder.shape(at).is_square())
      throw InputError(expression.place(pair), "a comparison of matrices needs square ones, not " +
                                                   to_string(binder.shape(at)) +
                                                   "; elements are compared by min(x) >= a, max(x) "
                                                   "<= b or abs(x) <= b");
    relations.push_back(
        {binder.extract(at), relation == Relation::less || relation == Relation::greater});
  }
  return relations;
}

}  // namespace gainsmith::expr
