#include "expr/text/rename.h"

#include <memory>
#include <set>

namespace gainsmith::expr {

namespace {

bool is_named(const Node& node) {
  return node.kind == NodeKind::name || node.kind == NodeKind::call;
}

/// The names that a call brings along: sum(i in 1..N, ...), maximum(f, x in [a, b]).
std::set<std::string> indices_of(const Node& node) {
  std::set<std::string> indices;
  for (const NodePtr& child : node.children)
    if (child->kind == NodeKind::each || child->kind == NodeKind::within)
      indices.insert(child->text);
  return indices;
}

/// `indices`: names that sums or boxes around the node bind.
NodePtr changed(const Node& node, const Renaming& to, std::set<std::string> indices) {
  auto result = std::make_shared<Node>(node);
  if (is_named(node) && !indices.contains(node.text))
    if (auto name = to(node.text)) result->text = std::move(*name);
  indices.merge(indices_of(node));
  for (NodePtr& child : result->children) child = changed(*child, to, indices);
  return result;
}

/// Calls `seen` for names and calls that no sum or box around them binds.
void visit(const Node& node, const std::function<void(const Node&)>& seen,
           std::set<std::string> indices) {
  if (is_named(node) && !indices.contains(node.text)) seen(node);
  indices.merge(indices_of(node));
  for (const NodePtr& child : node.children) visit(*child, seen, indices);
}

}  // namespace

Expression renamed(const Expression& expression, const Renaming& to) {
  return {expression.text, changed(*expression.root, to, {})};
}

void visit_names(const Expression& expression, const std::function<void(const Node&)>& seen) {
  visit(*expression.root, seen, {});
}

}  // namespace gainsmith::expr
