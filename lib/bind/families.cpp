#include "bind/families.h"

#include <functional>
#include <memory>

#include "expr/binding/compile.h"

namespace gainsmith::bind {

std::string Member::name_of(const std::string& family) const {
  return expr::member_name(family, values);
}

/// Titles are for persons, names for programs.
std::string Member::title_of(const std::string& family) const {
  return label.empty() ? family : family + " at " + label;
}

/// Nested loops as a recursion over indices; conditions are asked where all have values.
std::vector<Member> members(const std::vector<expr::Index>& indices,
                            const std::vector<expr::Expression>& conditions,
                            const expr::Scope& scope) {
  constexpr std::size_t kMost = 100'000;
  std::size_t tried = 0;
  std::vector<Member> found;
  expr::Scope inner = scope;
  Member member;
  const std::function<void(std::size_t)> from = [&](std::size_t k) {
    if (k == indices.size()) {
      if (++tried > kMost)
        throw InputError(indices.front().place,
                         "the indices have more than " + std::to_string(kMost) + " values");
      for (const expr::Expression& condition : conditions)
        if (!expr::whole_condition(condition, inner)) return;
      found.push_back(member);
      return;
    }
    const expr::Index& index = indices[k];
    const auto [low, high] = expr::range_of(index, inner);
    const std::string outer = member.label;
    for (int i = low; i <= high; ++i) {
      inner.dimensions[index.name] = i;
      member.values.push_back(i);
      member.indices[index.name] = i;
      member.label = outer + (outer.empty() ? "" : ", ") + index.name + " = " + std::to_string(i);
      from(k + 1);
      member.values.pop_back();
    }
    member.label = outer;
    member.indices.erase(index.name);
    inner.dimensions.erase(index.name);
  };
  from(0);
  return found;
}

/// At most 10,000 members for each index.
expr::Ranges ranges(const std::vector<expr::Index>& indices, const expr::Scope& scope) {
  constexpr int kMost = 10'000;
  expr::Ranges result;
  for (const expr::Index& index : indices) {
    const auto [low, high] = expr::range_of(index, scope);
    if (low < 0 || high < low || high - low >= kMost)
      throw InputError(index.place, "the index " + index.name + " of a family runs from " +
                                        std::to_string(low) + " to " + std::to_string(high) +
                                        "; expected 0 <= first <= last, and at most " +
                                        std::to_string(kMost) + " members");
    result.emplace_back(low, high);
  }
  return result;
}

/// A flat list gives numbers, a list of rows gives a row for each member, a list of matrices the
/// matrices.
std::vector<model::Value> elements_of(const model::Value& value) {
  if (!value.matrices.empty()) return value.matrices;
  std::vector<model::Value> elements;
  if (!value.list) return elements;
  const expr::Node& root = *value.value.root;
  const auto add = [&](const expr::NodePtr& node, bool flat) {
    const expr::Expression element{value.value.text, node};
    elements.push_back({value.name, element, flat, element.place(*node)});
  };
  if (value.flat) {
    for (const expr::NodePtr& child : root.children) add(child, false);
    return elements;
  }
  const auto width = static_cast<std::size_t>(root.columns);
  for (std::size_t at = 0; at < root.children.size(); at += width) {
    auto row = std::make_shared<expr::Node>(root);
    row->children.assign(root.children.begin() + static_cast<std::ptrdiff_t>(at),
                         root.children.begin() + static_cast<std::ptrdiff_t>(at + width));
    row->begin = row->children.front()->begin;
    row->end = row->children.back()->end;
    add(row, true);
  }
  return elements;
}

/// 1..N alone: other ranges would have to be solved for N.
bool learn_count(const std::vector<expr::Index>& indices, std::size_t count,
                 std::map<std::string, int>& dimensions) {
  if (indices.size() != 1) return false;
  const expr::Index& index = indices.front();
  const bool ends =
      index.high.root->kind == expr::NodeKind::name && !dimensions.contains(index.high.root->text);
  if (!ends || index.low.root->kind != expr::NodeKind::number || index.low.root->text != "1")
    return false;
  dimensions[index.high.root->text] = static_cast<int>(count);
  return true;
}

expr::Expression instantiate(const expr::Expression& expression, const Member& member,
                             const expr::Scope& scope) {
  if (member.indices.empty()) return expression;
  return expr::instantiate(expression, member.indices, scope.families);
}

}  // namespace gainsmith::bind
