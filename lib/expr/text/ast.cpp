#include "expr/text/ast.h"

#include <utility>

#include "base/words.h"

namespace gainsmith::expr {

std::string to_string(Relation relation) {
  return word_of<Relation::not_equal>(relation, {"<", "<=", ">", ">=", "==", "!="});
}

/// At most 40 characters on one line; what is left out is "...".
std::string Expression::quote(const Node& node) const {
  constexpr std::size_t kLongest = 40;
  std::string source = text->str().substr(node.begin, node.end - node.begin);
  for (char& c : source)
    if (c == '\n') c = ' ';
  if (source.size() > kLongest) source = source.substr(0, kLongest - 3) + "...";
  return source;
}

namespace {

void collect(const Node& node, std::set<std::string>& names) {
  if (node.kind == NodeKind::name || node.kind == NodeKind::call) names.insert(node.text);
  for (const NodePtr& child : node.children) collect(*child, names);
}

}  // namespace

/// In the order of the text, also of `and` within parentheses.
std::vector<Expression> conjuncts(const Expression& expression) {
  if (expression.root->kind != NodeKind::conjunction) return {expression};
  std::vector<Expression> all;
  for (const NodePtr& part : expression.root->children)
    for (Expression& one : conjuncts({expression.text, part})) all.push_back(std::move(one));
  return all;
}

/// Names that sums and boxes bind are among them.
std::set<std::string> names_in(const Expression& expression) {
  std::set<std::string> names;
  collect(*expression.root, names);
  return names;
}

}  // namespace gainsmith::expr
