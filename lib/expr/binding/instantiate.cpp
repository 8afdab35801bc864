#include "expr/binding/instantiate.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace gainsmith::expr {

namespace {

/// The value of a node of numbers, + - and *.
std::optional<std::int64_t> value_of(const Node& node) {
  if (node.kind == NodeKind::number) {
    std::int64_t value = 0;
    const char* const last = node.text.data() + node.text.size();
    const auto end = std::from_chars(node.text.data(), last, value);
    return end.ec == std::errc() && end.ptr == last ? std::optional(value) : std::nullopt;
  }
  if (node.children.size() != 2) return std::nullopt;
  const auto a = value_of(*node.children[0]);
  const auto b = value_of(*node.children[1]);
  constexpr std::int64_t kMost = 1'000'000'000;
  if (!a || !b || std::abs(*a) > kMost || std::abs(*b) > kMost) return std::nullopt;
  switch (node.kind) {
    case NodeKind::add:
      return *a + *b;
    case NodeKind::subtract:
      return *a - *b;
    case NodeKind::multiply:
      return *a * *b;
    default:
      return std::nullopt;
  }
}

/// Replaces indices by numbers and members by names, in tree and text alike, and moves all places.
class Instantiation {
 public:
  Instantiation(const Expression& expression, const std::map<std::string, int>& indices,
                const std::map<std::string, Ranges>& families)
      : expression_(expression), indices_(indices), families_(families) {}

  /// Pieces are sorted by place, so that the text is written in one pass.
  Expression run() {
    NodePtr root = changed(*expression_.root);
    if (replaced_.empty()) return expression_;
    std::sort(replaced_.begin(), replaced_.end(),
              [](const Piece& a, const Piece& b) { return a.begin < b.begin; });
    auto text = std::make_shared<const Text>(written());
    return {text, moved(*root)};
  }

 private:
  /// Bytes of the old text, and what replaces them.
  struct Piece {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };

  /// A leaf in place of a node. What was replaced inside of the node is covered by it.
  std::shared_ptr<Node> replaced(const Node& node, NodeKind kind, std::string text) {
    std::erase_if(replaced_, [&](const Piece& piece) {
      return node.begin <= piece.begin && piece.end <= node.end;
    });
    replaced_.push_back({node.begin, node.end, text});
    auto result = std::make_shared<Node>(node);
    result->kind = kind;
    result->text = std::move(text);
    result->children.clear();
    result->height = 1;
    return result;
  }

  /// "P_2" when the node, whose arguments were changed, is a member.
  /// None too where an index is not a number yet, or is outside of its range.
  std::optional<std::string> member(const Node& node) const {
    const auto family = families_.find(node.text);
    if (node.kind != NodeKind::call || family == families_.end() ||
        family->second.size() != node.children.size())
      return std::nullopt;
    std::vector<int> values;
    for (std::size_t k = 0; k < node.children.size(); ++k) {
      const auto value = value_of(*node.children[k]);
      const auto [low, high] = family->second[k];
      if (!value || *value < low || *value > high) return std::nullopt;
      values.push_back(static_cast<int>(*value));
    }
    return member_name(node.text, values);
  }

  /// Children first, so that an index of a member is a number when the member is named.
  NodePtr changed(const Node& node) {
    const bool binds = node.kind == NodeKind::each || node.kind == NodeKind::within;
    if (binds && indices_.contains(node.text))
      throw InputError(expression_.place(node),
                       "'" + node.text + "' already is an index here; name that of the " +
                           (node.kind == NodeKind::each ? "sum" : "box") + " otherwise");
    if (node.kind == NodeKind::name)
      if (const auto found = indices_.find(node.text); found != indices_.end())
        return replaced(node, NodeKind::number, std::to_string(found->second));
    auto result = std::make_shared<Node>(node);
    for (NodePtr& child : result->children) child = changed(*child);
    if (const auto name = member(*result)) return replaced(node, NodeKind::name, *name);
    // P(2)(s) is the call of a name.
    if (result->kind == NodeKind::index && node.children[0]->kind == NodeKind::call &&
        result->children[0]->kind == NodeKind::name) {
      result->kind = NodeKind::call;
      result->text = result->children[0]->text;
      result->children.erase(result->children.begin());
    }
    return result;
  }

  /// The new text; each byte has the place of what was written there.
  Text written() const {
    const Text& old = *expression_.text;
    std::string text;
    std::vector<Position> positions;
    const auto add = [&](char c, std::size_t at) {
      text += c;
      const Place place = old.place(at);
      positions.push_back({place.line, place.column});
    };
    std::size_t at = 0;
    const auto copy_to = [&](std::size_t end) {
      for (; at < end; ++at) add(old.str()[at], at);
    };
    for (const Piece& piece : replaced_) {
      copy_to(piece.begin);
      for (const char c : piece.text) add(c, piece.begin);
      at = piece.end;
    }
    copy_to(old.str().size());
    const Place end = old.place(old.str().size());
    positions.push_back({end.line, end.column});
    return {text, old.file(), std::move(positions)};
  }

  /// Where a byte of the old text, no inner one of a piece, is in the new one.
  std::size_t moved(std::size_t at) const {
    std::size_t result = at;
    for (const Piece& piece : replaced_)
      if (piece.end <= at) result = result + piece.text.size() - (piece.end - piece.begin);
    return result;
  }

  /// The tree with places in the new text.
  NodePtr moved(const Node& node) const {
    auto result = std::make_shared<Node>(node);
    result->begin = moved(node.begin);
    result->end = moved(node.end);
    for (NodePtr& child : result->children) child = moved(*child);
    return result;
  }

  const Expression& expression_;
  const std::map<std::string, int>& indices_;
  const std::map<std::string, Ranges>& families_;
  std::vector<Piece> replaced_;
};

}  // namespace

Expression instantiate(const Expression& expression, const std::map<std::string, int>& indices,
                       const std::map<std::string, Ranges>& families) {
  return Instantiation(expression, indices, families).run();
}

}  // namespace gainsmith::expr
