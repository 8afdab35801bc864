// flow_map(e, x, d): the rate e as a program of its own in x, in the time where e depends on it,
// and in what is constant meanwhile.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// x' = e(x, t) from the value of x over the time d. Operands: x, d, then the time where e depends
/// on it (attributes[0] = 1), then what e reads besides, which is constant meanwhile.
Bound Binder::flow_map(const Expression& expression, const Node& node) {
  const Varied rate = varied(expression, node, 0, 1, true);
  const Node& length = *node.children[2];
  const int d = materialise(expression, length, bind(expression, length), {});
  std::vector<int> operands = {rate.point, d};
  std::vector<std::pair<int, std::string>> inputs = {{rate.variable, "the variable"}};
  Attributes attributes{};
  if (!scope_.time.empty()) {
    Instruction like;
    like.origin = expression.text;
    like.offset = node.begin;
    const int time = assembly_.add_input(scope_.time, {}, like);
    const bool moves = rate.variable != time &&
                       depending_on({time}, rate.value)[static_cast<std::size_t>(rate.value)];
    if (moves) {
      inputs.emplace_back(time, "the time");
      operands.push_back(time);
      attributes = {1};
    }
  }
  const Body body = body_of(rate.value, inputs, operands.size());
  if (!body.call.empty())
    fail(expression, node,
         "'" + body.call + "' is a call of an unknown or a gain, along which nothing is moved");
  require_past(expression, node, body.outside);
  operands.insert(operands.end(), body.outside.begin(), body.outside.end());
  auto program = std::make_shared<const Program>(body.assembly.extract(body.result));
  const Shape result = shape(rate.point);
  return {emit(expression, node, Op::flow_map, std::move(operands), result, attributes, {},
               std::move(program))};
}

/// A flow_map may go back in time, d < 0, where measurements and draws are not known.
void Binder::require_past(const Expression& expression, const Node& node,
                          const std::vector<int>& outside) const {
  for (const int at : outside)
    for (const Input& input : assembly_.extract(at).inputs) {
      const auto found = scope_.without_past.find(input.name);
      if (found != scope_.without_past.end()) fail(expression, node, "flow_map: " + found->second);
    }
}

}  // namespace gainsmith::expr
