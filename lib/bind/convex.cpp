// Each function has an exact representation by linear matrix inequalities (Boyd and Vandenberghe,
// Convex Optimization, 2004): norm(M) <= g by a Schur complement, lambda_max(M) <= g by M <= g I,
// the rest element by element on diagonals.
#include "bind/convex.h"

#include "bind/trees.h"
namespace gainsmith::bind {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;

/// By the name of the function alone; whether it has unknowns is asked elsewhere.
std::optional<Curvature> curvature_of(const Node& node) {
  if (node.kind != NodeKind::call || node.children.empty()) return std::nullopt;
  const std::string& name = node.text;
  if (name == "norm" || name == "abs" || name == "max" || name == "lambda_max")
    return Curvature::convex;
  if (name == "min" || name == "lambda_min") return Curvature::concave;
  return std::nullopt;
}

/// M of shape p x q gives the block [g I_p, M; M', g I_q].
std::vector<NodePtr> comparisons_of(const Node& call, const NodePtr& bound,
                                    const std::vector<expr::Shape>& arguments, bool bound_is_number,
                                    bool strict) {
  const Trees trees(call);
  const NodePtr& argument = call.children.front();
  const NodePtr multiple = trees.times(bound, trees.identity());
  if (call.text == "norm") {
    const auto corner = [&](int size) {
      return trees.times(bound, trees.call("eye", trees.number(size)));
    };
    const NodePtr block =
        trees.block({corner(arguments.front().rows), argument, trees.make(NodeKind::mirror, {}),
                     corner(arguments.front().cols)});
    return {trees.at_most(trees.number(0), block, strict)};
  }
  if (call.text == "lambda_max") return {trees.at_most(argument, multiple, strict)};
  if (call.text == "lambda_min") return {trees.at_most(multiple, argument, strict)};
  // Vectors are compared as diagonal matrices, numbers with them as multiples of I.
  const NodePtr limit = bound_is_number ? multiple : trees.call("diag", bound);
  std::vector<NodePtr> comparisons;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const NodePtr& child = call.children[k];
    const bool number = arguments[k].is_scalar();
    const NodePtr value = !number           ? trees.call("diag", child)
                          : bound_is_number ? child
                                            : trees.times(child, trees.identity());
    const NodePtr& other = number && bound_is_number ? bound : limit;
    if (call.text == "abs")
      comparisons.push_back(trees.at_most(trees.make(NodeKind::negate, {other}), value, strict));
    comparisons.push_back(call.text == "min" ? trees.at_most(other, value, strict)
                                             : trees.at_most(value, other, strict));
  }
  return comparisons;
}

}  // namespace gainsmith::bind
