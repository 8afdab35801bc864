#include <algorithm>
#include <optional>
#include <utility>

#include "expr/binder.h"

namespace gainsmith::expr {

namespace {

int value_of(const std::vector<int>& sizes, std::size_t at) { return sizes[at]; }

}  // namespace

Bound Binder::bind_call(const Expression& expression, const Node& node) {
  const std::string& name = node.text;
  const bool is_value =
      environment_.contains(name) || scope_.symbols.contains(name) || name == "I" || name == "pi";
  if (is_value) {
    Node base = node;
    base.kind = NodeKind::name;
    return index(expression, node, bind_name(expression, base), 0);
  }
  if (const auto found = scope_.definitions.find(name); found != scope_.definitions.end()) {
    if (found->second.parameters.empty())
      return index(expression, node, bind_definition(expression, node, name, {}), 0);
    std::vector<Bound> arguments;
    for (const NodePtr& child : node.children) arguments.push_back(bind(expression, *child));
    return bind_definition(expression, node, name, std::move(arguments));
  }
  if (const auto found = scope_.functions.find(name); found != scope_.functions.end())
    return bind_given_function(expression, node, found->second);
  const Function* function = find_function(name);
  if (function == nullptr) unknown_name(expression, node);
  const int count = static_cast<int>(node.children.size());
  if (count < function->fewest || (function->most >= 0 && count > function->most))
    fail(expression, node,
         "'" + name + "' is written " + std::string(function->usage) + "; found " +
             std::to_string(count) + " arguments");
  return bind_function(expression, node, *function);
}

Bound Binder::bind_given_function(const Expression& expression, const Node& node, Shape of) {
  if (node.children.size() != 1)
    fail(expression, node,
         "'" + node.text + "' takes 1 arguments, not " + std::to_string(node.children.size()));
  const Node& argument = *node.children.front();
  const int at = materialise(expression, argument, bind(expression, argument), {});
  Instruction like;
  like.origin = expression.text;
  like.offset = node.begin;
  like.text = expression.text->str().substr(node.begin, node.end - node.begin);
  return {assembly_.add_call(node.text, of, at, like)};
}

Bound Binder::bind_function(const Expression& expression, const Node& node,
                            const Function& function) {
  const auto argument = [&](std::size_t i) { return bind(expression, *node.children[i]); };
  switch (function.id) {
    case FunctionId::He: {
      const Bound a = argument(0);
      if (a.identity || shape(a.at).is_scalar())
        return {emit(expression, node, Op::add, {a.at, a.at}, {}), a.identity};
      const int at = square(expression, *node.children[0], a, function.name);
      const Bound mirrored = transpose(expression, node, {at});
      return {emit(expression, node, Op::add, {at, mirrored.at}, shape(at))};
    }
    case FunctionId::inv: {
      const Bound a = argument(0);
      if (a.identity) return {emit(expression, node, Op::inverse, {a.at}, {}), true};
      const int at = square(expression, *node.children[0], a, function.name);
      return {emit(expression, node, Op::inverse, {at}, shape(at))};
    }
    case FunctionId::pinv: {
      const int at = sized(expression, *node.children[0], argument(0));
      return {emit(expression, node, Op::pseudo_inverse, {at}, {shape(at).cols, shape(at).rows})};
    }
    case FunctionId::expm: {
      const int at = square_argument(expression, node, function.name);
      return {emit(expression, node, Op::matrix_exponential, {at}, shape(at))};
    }
    case FunctionId::trace: {
      const int at = square_argument(expression, node, function.name);
      return {emit(expression, node, Op::trace, {at}, {})};
    }
    case FunctionId::norm: {
      const int at = sized(expression, *node.children[0], argument(0));
      return {emit(expression, node, Op::norm, {at}, {})};
    }
    case FunctionId::exp:
      return elementwise(expression, node, Op::exp);
    case FunctionId::log:
      return elementwise(expression, node, Op::log);
    case FunctionId::sqrt:
      return elementwise(expression, node, Op::sqrt);
    case FunctionId::sin:
      return elementwise(expression, node, Op::sin);
    case FunctionId::cos:
      return elementwise(expression, node, Op::cos);
    case FunctionId::tanh:
      return elementwise(expression, node, Op::tanh);
    case FunctionId::abs:
      return elementwise(expression, node, Op::abs);
    case FunctionId::sign:
      return elementwise(expression, node, Op::sign);
    case FunctionId::min:
      return fold_minmax(expression, node, Op::minimum);
    case FunctionId::max:
      return fold_minmax(expression, node, Op::maximum);
    case FunctionId::clip:
      return clip(expression, node);
    case FunctionId::where:
      return where(expression, node);
    case FunctionId::eye:
    case FunctionId::zeros:
    case FunctionId::ones:
      return constant_matrix(expression, node, function.id);
    case FunctionId::diag:
      return diagonal(expression, node);
    case FunctionId::blkdiag:
      return block_diagonal(expression, node);
    case FunctionId::orth:
      return basis(expression, node, Op::range_basis);
    case FunctionId::null:
      return basis(expression, node, Op::kernel_basis);
    case FunctionId::svd: {
      const int at = sized(expression, *node.children[0], argument(0));
      return {emit(expression, node, Op::singular_values, {at},
                   {std::min(shape(at).rows, shape(at).cols), 1})};
    }
    case FunctionId::obsv:
      return observability(expression, node);
    case FunctionId::gramian:
    case FunctionId::backward_gramian:
      return gramian(expression, node, function.id == FunctionId::backward_gramian);
  }
  fail(expression, node, "unknown function");
}

int Binder::square_argument(const Expression& expression, const Node& node,
                            std::string_view function) {
  const Node& argument = *node.children[0];
  return square(expression, argument, bind(expression, argument), function);
}

int Binder::square(const Expression& expression, const Node& argument, Bound value,
                   std::string_view function) {
  const int at = sized(expression, argument, value);
  if (!shape(at).is_square())
    fail(expression, argument,
         std::string(function) + " needs a square matrix, not " +
             describe(expression, argument, value));
  return at;
}

Bound Binder::elementwise(const Expression& expression, const Node& node, Op op) {
  const int at = sized(expression, *node.children[0], bind(expression, *node.children[0]));
  return {emit(expression, node, op, {at}, shape(at))};
}

int Binder::same_shape(const Expression& expression, const Node& node, Bound value, Shape wanted) {
  if (!value.identity && shape(value.at).is_scalar() && !wanted.is_scalar())
    return emit(expression, node, Op::fill, {value.at}, wanted);
  return materialise(expression, node, value, wanted);
}

Bound Binder::fold_minmax(const Expression& expression, const Node& node, Op op) {
  std::vector<Bound> values;
  Shape common;
  for (const NodePtr& child : node.children) {
    values.push_back(bind(expression, *child));
    const int at = sized(expression, *child, values.back());
    if (!shape(at).is_scalar()) common = shape(at);
  }
  int result = same_shape(expression, *node.children[0], values[0], common);
  for (std::size_t i = 1; i < values.size(); ++i)
    result = emit(expression, node, op,
                  {result, same_shape(expression, *node.children[i], values[i], common)}, common);
  return {result};
}

Bound Binder::clip(const Expression& expression, const Node& node) {
  const auto sized_argument = [&](std::size_t i) {
    return sized(expression, *node.children[i], bind(expression, *node.children[i]));
  };
  const int x = sized_argument(0);
  const int low = same_shape(expression, *node.children[1], {sized_argument(1)}, shape(x));
  const int high = same_shape(expression, *node.children[2], {sized_argument(2)}, shape(x));
  const int raised = emit(expression, node, Op::maximum, {x, low}, shape(x));
  return {emit(expression, node, Op::minimum, {raised, high}, shape(x))};
}

Bound Binder::where(const Expression& expression, const Node& node) {
  const Node& condition = *node.children[0];
  if (condition.kind != NodeKind::compare || condition.relations.size() != 1)
    fail(expression, condition, "where needs one comparison first, such as where(x > 0, a, b)");
  const Relation relation = condition.relations.front();
  const bool ascending = relation == Relation::less || relation == Relation::less_equal;
  const bool strict = relation == Relation::less || relation == Relation::greater;
  const Bound left = bind(expression, *condition.children[0]);
  const Bound right = bind(expression, *condition.children[1]);
  Node ordered = condition;
  if (ascending) std::swap(ordered.children[0], ordered.children[1]);
  const Bound difference = ascending ? subtract(expression, ordered, right, left)
                                     : subtract(expression, ordered, left, right);
  const Bound yes = bind(expression, *node.children[1]);
  const Bound no = bind(expression, *node.children[2]);
  Shape common;
  for (const Bound& value : {difference, yes, no}) {
    const int at = sized(expression, node, value);
    if (!shape(at).is_scalar()) common = shape(at);
  }
  return {emit(expression, node, Op::where,
               {same_shape(expression, condition, difference, common),
                same_shape(expression, *node.children[1], yes, common),
                same_shape(expression, *node.children[2], no, common)},
               common, {strict ? 1 : 0})};
}

Bound Binder::constant_matrix(const Expression& expression, const Node& node, FunctionId id) {
  constexpr int kLargest = 100000;
  std::vector<int> sizes;
  for (const NodePtr& child : node.children) {
    const auto size = whole_number(expression, *child);
    if (!size || *size < 0 || *size > kLargest)
      fail(expression, *child,
           "a size must be a whole number known beforehand, from 0 to " + std::to_string(kLargest));
    sizes.push_back(*size);
  }
  const Shape wanted{value_of(sizes, 0), sizes.back()};
  if (id == FunctionId::zeros) return {emit(expression, node, Op::zeros, {}, wanted)};
  const int one = number(expression, node, "1");
  const Op op = id == FunctionId::eye ? Op::identity : Op::fill;
  return {emit(expression, node, op, {one}, wanted)};
}

Bound Binder::diagonal(const Expression& expression, const Node& node) {
  const Node& argument = *node.children[0];
  const Bound value = bind(expression, argument);
  const int at = sized(expression, argument, value);
  const Shape from = shape(at);
  if (from.rows == 1 || from.cols == 1)
    return {emit(expression, node, Op::diagonal_matrix, {at}, {from.size(), from.size()})};
  if (!from.is_square())
    fail(expression, argument,
         "diag needs a vector or a square matrix, not " + describe(expression, argument, value));
  return {emit(expression, node, Op::diagonal_of, {at}, {from.rows, 1})};
}

Bound Binder::block_diagonal(const Expression& expression, const Node& node) {
  std::vector<int> blocks;
  std::vector<int> heights;
  std::vector<int> widths;
  for (const NodePtr& child : node.children) {
    blocks.push_back(sized(expression, *child, bind(expression, *child)));
    heights.push_back(shape(blocks.back()).rows);
    widths.push_back(shape(blocks.back()).cols);
  }
  std::vector<int> entries;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t j = 0; j < blocks.size(); ++j)
      entries.push_back(i == j ? blocks[i]
                               : emit(expression, node, Op::zeros, {}, {heights[i], widths[j]}));
  return {assemble(expression, node, std::move(entries), static_cast<int>(blocks.size()), heights,
                   widths)};
}

Program Binder::known_program(const Expression& expression, const Node& node, int at,
                              std::string_view why) {
  Program program = extract(at);
  const auto refuse = [&](const std::string& name) {
    fail(expression, node,
         std::string(why) + " must not depend on '" + name +
             "', whose value is not known beforehand");
  };
  for (const Input& input : program.inputs)
    if (!scope_.known || !scope_.symbols.at(input.name).known) refuse(input.name);
  for (const Input& function : program.functions) refuse(function.name);
  return program;
}

Bound Binder::basis(const Expression& expression, const Node& node, Op op) {
  const Node& argument = *node.children[0];
  const int at = sized(expression, argument, bind(expression, argument));
  std::optional<Program> tolerance;
  if (node.children.size() == 2) {
    const Node& second = *node.children[1];
    const int tolerance_at = materialise(expression, second, bind(expression, second), {});
    tolerance = known_program(expression, second, tolerance_at, "the tolerance");
  }
  const Program matrix = known_program(expression, argument, at, "the argument of " + node.text);
  if (!scope_.known) fail(expression, node, node.text + ": no value is known beforehand");
  if (tolerance && scope_.known->number(*tolerance) < 0)
    fail(expression, *node.children[1], "the tolerance must not be negative");
  const int rank = scope_.known->rank(matrix, tolerance ? &*tolerance : nullptr);
  const Shape from = shape(at);
  const Shape result =
      op == Op::range_basis ? Shape{from.rows, rank} : Shape{from.cols, from.cols - rank};
  return {emit(expression, node, op, {at}, result)};
}

Bound Binder::observability(const Expression& expression, const Node& node) {
  const int a = square_argument(expression, node, "obsv");
  const int c = sized(expression, *node.children[1], bind(expression, *node.children[1]));
  if (shape(c).cols != shape(a).rows)
    fail(expression, node,
         "obsv(A, C) needs C with " + std::to_string(shape(a).rows) + " columns, not " +
             describe(expression, *node.children[1], {c}));
  std::vector<int> rows = {c};
  for (int k = 1; k < shape(a).rows; ++k)
    rows.push_back(emit(expression, node, Op::multiply, {rows.back(), a}, shape(c)));
  const std::vector<int> heights(rows.size(), shape(c).rows);
  return {assemble(expression, node, std::move(rows), 1, heights, {shape(c).cols})};
}

}  // namespace gainsmith::expr
