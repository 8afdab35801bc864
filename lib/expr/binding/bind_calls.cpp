// Calls. A name with arguments may be, in this order: a matrix of a system, a member of a family, a
// number of an event, an indexed value, a definition, a function that is linked later, or one of
// the table.
#include <algorithm>
#include <map>
#include <optional>
#include <ranges>
#include <utility>
#include <variant>

#include "base/nearest.h"
#include "expr/binding/binder.h"
#include "expr/binding/chebyshev.h"
#include "expr/text/foreign_words.h"

namespace gainsmith::expr {

namespace {

int value_of(const std::vector<int>& sizes, std::size_t at) { return sizes[at]; }

}  // namespace

/// Names that the file gives hide functions of the language, and members of families come before
/// both.
Bound Binder::bind_call(const Expression& expression, const Node& node) {
  const std::string& name = node.text;
  if (name.starts_with('.'))
    return part_of_system(expression, node, bind_system(expression, *node.children[0]), name[1]);
  if (scope_.read) scope_.read->insert(name);
  if (const auto found = member_of_mode(expression, node)) return *found;
  if (const auto found = member(expression, node)) {
    Node plain = node;
    plain.kind = NodeKind::name;
    plain.text = *found;
    return bind_name(expression, plain);
  }
  if (const auto found = of_event(node)) return bind_name(expression, *found);
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
    for (const NodePtr& child : node.children) arguments.push_back(bind_value(expression, *child));
    return bind_definition(expression, node, name, std::move(arguments));
  }
  if (const auto found = scope_.functions.find(name); found != scope_.functions.end()) {
    if (node.children.size() != 1)
      fail(expression, node,
           "'" + name + "' takes 1 arguments, not " + std::to_string(node.children.size()));
    return bind_given_function(expression, node, name, *node.children.front(), found->second);
  }
  if (name == "rate" && node.children.size() == 1) return rate(expression, node);
  const Function* function = find_function(name);
  if (function == nullptr) unknown_name(expression, node);
  const int count = static_cast<int>(node.children.size());
  if (count < function->fewest || (function->most >= 0 && count > function->most))
    fail(expression, node,
         "'" + name + "' is written " + std::string(function->usage) + "; found " +
             std::to_string(count) + " arguments");
  if (const Op* op = std::get_if<Op>(&function->what))
    return bind_operation(expression, node, *function, *op);
  if (const Written* written = std::get_if<Written>(&function->what))
    return bind_written(expression, node, *written);
  return bind_composed(expression, node, std::get<Composed>(function->what));
}

namespace {

/// The tree of a text of the table as if it stood in a call: parameters are at the places of their
/// arguments, all else at that of the call.
NodePtr in_call(const Node& tree, const Node& call, const std::vector<std::string>& parameters) {
  const auto parameter = std::ranges::find(parameters, tree.text);
  const Node& place =
      tree.kind != NodeKind::name || parameter == parameters.end()
          ? call
          : *call.children[static_cast<std::size_t>(parameter - parameters.begin())];
  auto copy = std::make_shared<Node>(tree);
  copy->begin = place.begin;
  copy->end = place.end;
  for (NodePtr& child : copy->children) child = in_call(*child, call, parameters);
  return copy;
}

const Definition& definition_of(const Written& wanted) {
  static const std::map<std::string_view, Definition> all = [] {
    std::map<std::string_view, Definition> made;
    for (const Function& function : functions())
      if (const Written* written = std::get_if<Written>(&function.what)) {
        Definition& to = made[written->text];
        for (const auto part : std::views::split(written->parameters, std::string_view(", ")))
          to.parameters.emplace_back(part.begin(), part.end());
        to.body = parse(Text(std::string(written->text), std::string(function.name)));
      }
    return made;
  }();
  return all.at(wanted.text);
}

}  // namespace

Bound Binder::bind_written(const Expression& expression, const Node& node, const Written& written) {
  const Definition& of = definition_of(written);
  Environment arguments;
  for (std::size_t i = 0; i < of.parameters.size(); ++i) {
    const Node& argument = *node.children[i];
    arguments[of.parameters[i]] = {sized(expression, argument, bind(expression, argument))};
  }
  std::swap(environment_, arguments);
  const std::string outer = std::exchange(fault_, std::string(written.fault));
  const Bound value = bind(expression, *in_call(*of.body.root, node, of.parameters));
  fault_ = outer;
  std::swap(environment_, arguments);
  return value;
}

void Binder::unknown_name(const Expression& expression, const Node& node) const {
  for (const std::string_view word : {"nan", "NaN", "NAN", "inf", "Inf", "INF", "infinity"})
    if (node.text == word) fail(expression, node, "'" + node.text + "': a number must be finite");
  const std::string& text = expression.text->str();
  const std::size_t before = node.begin == 0 ? 0 : text.find_last_not_of(' ', node.begin - 1);
  const bool is_exponent = before < node.begin && text[before] == '^';
  for (const std::string_view word : {"T", "t", "H", "top"})
    if (is_exponent && node.text == word)
      fail(expression, node, "unexpected '^" + node.text + "': write ' for the transpose");
  // Of a component it is a state, "in_z.T"; a foreign transpose otherwise.
  if (constexpr std::string_view kTransposed = ".T"; node.text.ends_with(kTransposed))
    throw InputError(expression.text->place(node.begin + node.text.size() - kTransposed.size()),
                     "unexpected '.T': write ' for the transpose");
  if (node.text == kEnd)
    fail(expression, node, "'end' is only for an index, such as v(end) or A(:, n+1:end)");
  const std::string kind = node.kind == NodeKind::call ? "function" : "name";
  if (const std::string advice = advice_on(node.text);
      !advice.empty() && node.kind == NodeKind::call)
    fail(expression, node, "unknown function '" + node.text + "': " + advice);
  std::vector<std::string> candidates = scope_.names();
  for (const auto& [name, value] : environment_) candidates.push_back(name);
  // count(sample), observer.xh come after the names that the file gives.
  std::stable_partition(candidates.begin(), candidates.end(), [](const std::string& name) {
    return name.find_first_of("(.") == std::string::npos;
  });
  if (node.kind == NodeKind::call) {
    const auto functions = function_names();
    candidates.insert(candidates.begin(), functions.begin(), functions.end());
  }
  // "x1" of a state x: columns of tables and pictures have such names.
  const std::size_t digits = node.text.find_last_not_of("0123456789") + 1;
  const std::string whole = node.text.substr(0, digits);
  if (digits < node.text.size() && node.kind != NodeKind::call &&
      std::find(candidates.begin(), candidates.end(), whole) != candidates.end())
    fail(expression, node,
         "unknown name '" + node.text + "'; an element of " + whole + " is written " + whole + "(" +
             node.text.substr(digits) + ")");
  const auto near = nearest(node.text, candidates);
  const bool other_case = near && differs_in_case(node.text, *near);
  fail(expression, node,
       "unknown " + kind + " '" + node.text + "'" + (other_case ? "; case counts" : "") +
           suggestion(node.text, candidates));
}

/// count(sample) is a name where the scope has it.
std::optional<Node> Binder::of_event(const Node& node) const {
  if (node.children.size() != 1 || node.children[0]->kind != NodeKind::name) return std::nullopt;
  Node plain = node;
  plain.kind = NodeKind::name;
  plain.text = event_number(node.text, node.children[0]->text);
  plain.children.clear();
  if (!scope_.symbols.contains(plain.text)) return std::nullopt;
  return plain;
}

/// A function of the scope under the name "derivative(P)", linked later like P itself.
std::optional<Bound> Binder::bind_derivative(const Expression& expression, const Node& node) {
  const Node& whole = node.kind == NodeKind::index ? *node.children[0] : node;
  if (whole.kind != NodeKind::call || whole.text != "derivative") return std::nullopt;
  const bool one = whole.children.size() == 1 && &whole != &node && node.children.size() == 2;
  const auto of = one ? member(expression, *whole.children[0]) : std::nullopt;
  if (!one || (!of && whole.children[0]->kind != NodeKind::name))
    fail(expression, node, "the derivative of a function P at s is written derivative(P)(s)");
  const std::string function = of ? *of : whole.children[0]->text;
  const std::string name = derivative_name(function);
  const auto found = scope_.functions.find(name);
  if (found == scope_.functions.end())
    fail(expression, *whole.children[0],
         "'" + function + "' is no unknown function (of: s): only those have a derivative here");
  return bind_given_function(expression, node, name, *node.children[1], found->second);
}

/// The argument is a number; the value has the shape `of`.
Bound Binder::bind_given_function(const Expression& expression, const Node& node,
                                  const std::string& name, const Node& argument, Shape of) {
  const int at = materialise(expression, argument, bind(expression, argument), {});
  Instruction like;
  like.origin = expression.text;
  like.offset = node.begin;
  like.text = expression.text->str().substr(node.begin, node.end - node.begin);
  return {assembly_.add_call(name, of, at, like)};
}

std::optional<Shape> Binder::shape_of(Op op, const std::vector<int>& operands,
                                      const Attributes& attributes) const {
  std::vector<Shape> shapes;
  shapes.reserve(operands.size());
  for (const int operand : operands) shapes.push_back(shape(operand));
  return result_shape(op, shapes, attributes);
}

void Binder::not_square(const Expression& expression, const Node& argument, Bound value,
                        std::string_view function) const {
  fail(expression, argument,
       std::string(function) + " needs a square matrix, not " +
           describe(expression, argument, value));
}

int Binder::square_argument(const Expression& expression, const Node& node,
                            std::string_view function) {
  const Node& argument = *node.children[0];
  const int at = sized(expression, argument, bind(expression, argument));
  if (!shape(at).is_square()) not_square(expression, argument, {at}, function);
  return at;
}

/// Where shapes do not fit, the message says which argument is at fault. The inverse of a multiple
/// of I is one again.
Bound Binder::bind_operation(const Expression& expression, const Node& node,
                             const Function& function, Op op) {
  if (operation(op).rule == ShapeRule::nearest_to_rows ||
      operation(op).rule == ShapeRule::nearest_to_form)
    return projection(expression, node, function, op);
  std::vector<int> operands;
  for (const NodePtr& child : node.children) {
    const Bound value = bind(expression, *child);
    if (value.identity && op == Op::inverse)
      return {emit(expression, node, op, {value.at}, {}), true};
    operands.push_back(sized(expression, *child, value));
  }
  if (operands.size() == 2 && operation(op).rule == ShapeRule::elementwise) {
    const Shape common = shape(operands[shape(operands[0]).is_scalar() ? 1 : 0]);
    for (std::size_t i = 0; i < 2; ++i)
      operands[i] = same_shape(expression, *node.children[i], {operands[i]}, common);
  }
  const auto result = shape_of(op, operands);
  if (result) return {emit(expression, node, op, operands, *result)};
  const Node& first = *node.children[0];
  if (operands.size() == 1) not_square(expression, first, {operands[0]}, function.name);
  for (std::size_t i = 1; i < operands.size(); ++i)
    materialise(expression, *node.children[i], {operands[i]}, shape(operands[0]));
  fail(expression, node, std::string(function.usage) + ": the shapes do not fit");
}

Bound Binder::bind_composed(const Expression& expression, const Node& node, Composed function) {
#define CALL(method, ...) method(expression, node __VA_OPT__(, ) __VA_ARGS__)
  switch (function) {
#define COMPOSED(name, method, ...) \
  case Composed::name:              \
    return CALL method;
#include "expr/operations.def"
  }
#undef CALL
  fail(expression, node, "unknown function");
}

/// He(s I) = 2 s I.
Bound Binder::symmetric(const Expression& expression, const Node& node) {
  const Node& argument = *node.children[0];
  const Bound a = bind(expression, argument);
  if (!a.identity && !shape(a.at).is_square()) not_square(expression, argument, a, node.text);
  const Bound mirrored = transpose(expression, node, a);
  return {emit(expression, node, Op::add, {a.at, mirrored.at}, shape(a.at)), a.identity};
}

int Binder::same_shape(const Expression& expression, const Node& node, Bound value, Shape wanted) {
  if (!value.identity && shape(value.at).is_scalar() && !wanted.is_scalar())
    return emit(expression, node, Op::fill, {value.at}, wanted);
  return materialise(expression, node, value, wanted);
}

/// From left to right; numbers are filled into the shape of the others.
Bound Binder::fold_minmax(const Expression& expression, const Node& node, Op op) {
  if (node.children.size() == 1) return extreme_element(expression, node, op);
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

/// One size n means n x n.
Bound Binder::constant_matrix(const Expression& expression, const Node& node, Composed function) {
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
  if (function == Composed::zeros) return {emit(expression, node, Op::zeros, {}, wanted)};
  const int one = number(expression, node, "1");
  const Op op = function == Composed::eye ? Op::identity : Op::fill;
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

/// Zeros between blocks of any shapes.
Bound Binder::block_diagonal(const Expression& expression, const Node& node) {
  const std::vector<int> blocks = parts(expression, node);
  std::vector<int> heights;
  std::vector<int> widths;
  for (const int block : blocks) {
    heights.push_back(shape(block).rows);
    widths.push_back(shape(block).cols);
  }
  std::vector<int> entries;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t j = 0; j < blocks.size(); ++j)
      entries.push_back(i == j ? blocks[i]
                               : emit(expression, node, Op::zeros, {}, {heights[i], widths[j]}));
  return {assemble(expression, node, std::move(entries), static_cast<int>(blocks.size()), heights,
                   widths)};
}

/// By the recurrence of chebyshev.h, as products and differences of numbers.
Bound Binder::chebyshev(const Expression& expression, const Node& node) {
  constexpr int kMost = 100;
  const auto k = whole_number(expression, *node.children[0]);
  if (!k || *k < 0 || *k > kMost)
    fail(expression, *node.children[0],
         "the degree must be a whole number known beforehand, from 0 to " + std::to_string(kMost));
  const auto scalar = [&](std::size_t i) {
    const Node& argument = *node.children[i];
    return materialise(expression, argument, bind(expression, argument), {});
  };
  const int s = scalar(1);
  const int low = scalar(2);
  const int high = scalar(3);
  Chebyshev polynomials([&](const std::string& text) { return number(expression, node, text); },
                        [&](Op op, std::vector<int> operands) {
                          return emit(expression, node, op, std::move(operands), {});
                        },
                        s, low, high);
  return {polynomials.value(*k)};
}

}  // namespace gainsmith::expr
