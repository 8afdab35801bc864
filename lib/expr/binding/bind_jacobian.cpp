// jacobian(e, x): e as a program of its own in x and in what does not depend on x.
#include <memory>
#include <utility>
#include <vector>

#include "expr/binding/binder.h"

namespace gainsmith::expr {

/// Element (i, k) is de_i/dx_k, both counted column by column. The instruction carries e as its
/// body, which number types differentiate; derivative.h makes formulas of it where it has rules.
Bound Binder::jacobian(const Expression& expression, const Node& node) {
  const auto [value, variable, point] = varied(expression, node, 0, 1, false);
  const Shape result{shape(value).size(), shape(variable).size()};
  if (!depending_on({variable}, value)[static_cast<std::size_t>(value)])
    return {emit(expression, node, Op::zeros, {}, result)};
  const Body body = body_of(value, {{variable, "the variable"}}, 1);
  if (body.operations.contains(Op::jacobian))
    fail(expression, node, "a jacobian of a jacobian by the same variable is not computed");
  if (!body.call.empty())
    fail(expression, node,
         "'" + body.call + "' is a call of an unknown or a gain, which has no jacobian here");
  std::vector<int> operands = {point};
  operands.insert(operands.end(), body.outside.begin(), body.outside.end());
  auto program = std::make_shared<const Program>(body.assembly.extract(body.result));
  return {emit(expression, node, Op::jacobian, std::move(operands), result, {}, {},
               std::move(program))};
}

}  // namespace gainsmith::expr
