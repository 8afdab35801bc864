#include "expr/text/parser.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/stop.h"
#include "expr/text/token_cursor.h"
#include "expr/text/work.h"

namespace gainsmith::expr {

namespace {

/// The relation of a token; none for other tokens.
std::optional<Relation> relation_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::less:
      return Relation::less;
    case TokenKind::less_equal:
      return Relation::less_equal;
    case TokenKind::greater:
      return Relation::greater;
    case TokenKind::greater_equal:
      return Relation::greater_equal;
    case TokenKind::equal:
      return Relation::equal;
    case TokenKind::not_equal:
      return Relation::not_equal;
    default:
      return std::nullopt;
  }
}

/// The product or quotient of a token; none for other tokens.
std::optional<NodeKind> factor_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::star:
      return NodeKind::multiply;
    case TokenKind::slash:
      return NodeKind::divide;
    case TokenKind::point_star:
      return NodeKind::elementwise_multiply;
    case TokenKind::point_slash:
      return NodeKind::elementwise_divide;
    default:
      return std::nullopt;
  }
}

/// One function for each rule of parser.h. It reads a token once and never goes back.
class Parser : TokenCursor {
 public:
  using TokenCursor::TokenCursor;

  NodePtr whole() { return to_end(&Parser::condition); }

  NodePtr whole_element() { return to_end(&Parser::element); }

 private:
  NodePtr element() { return sum(true); }

  NodePtr to_end(NodePtr (Parser::*read)()) {
    if (peek() == TokenKind::end) fail("expected an expression, found nothing");
    NodePtr root = (this->*read)();
    refuse_decimal_comma();
    expect(TokenKind::end, "the end of the expression or an operator");
    return root;
  }

 public:
  Signature signature() {
    Signature result;
    result.name = expect(TokenKind::name, "a name").text;
    if (accept(TokenKind::open)) {
      if (is_index()) {
        do {
          result.indices.push_back(index());
          refuse_twice(result.indices, result.indices.back().name, result.indices.back().place);
        } while (accept(TokenKind::comma));
        expect(TokenKind::close, "',' or ')'");
        if (accept(TokenKind::open)) parameters(result);
      } else {
        parameters(result);
      }
    }
    expect(TokenKind::end, "':' or '(' after the name");
    return result;
  }

  Index whole_index() {
    Index result = index();
    expect(TokenKind::end, "the end of the range");
    return result;
  }

 private:
  void parameters(Signature& result) {
    do {
      const Token parameter = expect(TokenKind::name, "a parameter's name");
      if (std::find(result.parameters.begin(), result.parameters.end(), parameter.text) !=
          result.parameters.end())
        throw InputError(text()->place(parameter.begin),
                         "the parameter '" + parameter.text + "' is given twice");
      result.parameters.push_back(parameter.text);
    } while (accept(TokenKind::comma));
    expect(TokenKind::close, "',' or ')'");
  }

  static void refuse_twice(const std::vector<Index>& indices, const std::string& name,
                           const Place& place) {
    const auto count = std::ranges::count(indices, name, &Index::name);
    if (count > 1) throw InputError(place, "the index '" + name + "' is given twice");
  }

  /// "i in ..."
  bool is_index() const {
    return peek() == TokenKind::name && here(1).kind == TokenKind::name && here(1).text == "in";
  }

  Index index() {
    if (!is_index()) fail("expected an index such as i in 1..N");
    Index result;
    result.place = text()->place(here().begin);
    result.name = next().text;
    next();
    result.low = {text(), sum()};
    expect(TokenKind::dots, "'..' in the range of an index, such as 1..N");
    result.high = {text(), sum()};
    return result;
  }

  // Deeper nesting, or a longer chain such as 1 + 1 + ..., is no formula; it would only exhaust the
  // stack, here or where the tree is walked.
  static constexpr int kDeepest = 200;
  static constexpr int kTallest = 1000;

  /// Counts nested calls; InputError at kDeepest. What ends a call, an exception too, counts down.
  struct Depth {
    explicit Depth(Parser& p) : parser(p) {
      if (++parser.depth_ > kDeepest) parser.fail("the expression is nested too deeply");
    }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    ~Depth() { --parser.depth_; }
    Parser& parser;
  };

  /// A node from `begin` to the end of the last token. InputError for a tree above kTallest.
  std::shared_ptr<Node> make(NodeKind kind, std::size_t begin,
                             std::vector<NodePtr> children) const {
    auto node = std::make_shared<Node>();
    node->kind = kind;
    node->begin = begin;
    node->end = last_end(begin);
    node->children = std::move(children);
    for (const NodePtr& child : node->children)
      node->height = std::max(node->height, child->height + 1);
    if (node->height > kTallest) fail("the expression is nested too deeply");
    return node;
  }

  /// `or` binds less tightly than `and`, and `and` less than `not`; a lone operand is no node of
  /// its own.
  NodePtr condition() {
    const Depth depth(*this);
    const std::size_t begin = here().begin;
    std::vector<NodePtr> parts = {conjunction()};
    while (accept("or")) parts.push_back(conjunction());
    return parts.size() == 1 ? parts.front() : make(NodeKind::disjunction, begin, std::move(parts));
  }

  NodePtr conjunction() {
    const std::size_t begin = here().begin;
    std::vector<NodePtr> parts = {negation()};
    while (accept("and")) parts.push_back(negation());
    return parts.size() == 1 ? parts.front() : make(NodeKind::conjunction, begin, std::move(parts));
  }

  NodePtr negation() {
    const std::size_t begin = here().begin;
    if (!accept("not")) return comparison();
    const Depth depth(*this);
    NodePtr inner = negation();
    return make(NodeKind::negation, begin, {inner});
  }

  /// A chain a < b <= c is one node with its operands and relations.
  NodePtr comparison() {
    const std::size_t begin = here().begin;
    std::vector<NodePtr> operands = {sum()};
    std::vector<Relation> relations;
    while (const auto relation = relation_of(peek())) {
      next();
      relations.push_back(*relation);
      operands.push_back(sum());
    }
    if (relations.empty()) return operands.front();
    auto node = make(NodeKind::compare, begin, std::move(operands));
    node->relations = std::move(relations);
    return node;
  }

  /// "1 -1" in a block is two elements in MATLAB: it is refused, and so is no other spacing.
  void refuse_tight_sign() const {
    const Token& sign = here();
    if (sign.kind != TokenKind::plus && sign.kind != TokenKind::minus) return;
    const Token& after = here(1);
    const bool operand = after.kind != TokenKind::close_bracket && after.kind != TokenKind::end;
    if (operand && after.begin == sign.end && text()->str()[sign.begin - 1] == ' ')
      fail("a comma is missing before '" + sign.text + "', or a space behind it: write [a, " +
           sign.text + "b] for two elements, [a " + sign.text + " b] for one");
  }

  /// `element`: of a block.
  NodePtr sum(bool element = false) {
    const std::size_t begin = here().begin;
    NodePtr left = term();
    for (;;) {
      if (element) refuse_tight_sign();
      if (accept(TokenKind::plus)) {
        NodePtr right = term();
        left = make(NodeKind::add, begin, {left, right});
      } else if (accept(TokenKind::minus)) {
        NodePtr right = term();
        left = make(NodeKind::subtract, begin, {left, right});
      } else {
        return left;
      }
    }
  }

  NodePtr term() {
    const std::size_t begin = here().begin;
    NodePtr left = sign();
    while (const auto kind = factor_of(peek())) {
      next();
      NodePtr right = sign();
      left = make(*kind, begin, {left, right});
    }
    return left;
  }

  NodePtr sign() { return with_signs(&Parser::postfix); }

  /// Signs before a factor or an exponent: -a^b is -(a^b), and 2^-1 is allowed.
  NodePtr with_signs(NodePtr (Parser::*read)()) {
    const Depth depth(*this);
    const std::size_t begin = here().begin;
    if (accept(TokenKind::plus)) return with_signs(read);
    if (accept(TokenKind::minus)) {
      NodePtr operand = with_signs(read);
      return make(NodeKind::negate, begin, {operand});
    }
    return (this->*read)();
  }

  /// Left to right: A'*B and x(1)^2 need no parentheses, and a^b^c is (a^b)^c.
  NodePtr postfix() {
    const std::size_t begin = here().begin;
    NodePtr value = primary();
    for (;;) {
      if (accept(TokenKind::quote)) {
        value = make(NodeKind::transpose, begin, {value});
      } else if (peek() == TokenKind::caret || peek() == TokenKind::point_caret) {
        const bool whole = next().kind == TokenKind::caret;
        NodePtr exponent = this->exponent();
        value =
            make(whole ? NodeKind::power : NodeKind::elementwise_power, begin, {value, exponent});
      } else if (accept(TokenKind::open)) {
        value = apply(begin, value);
      } else if (peek() == TokenKind::part) {
        const std::string part = next().text;
        auto call = make(NodeKind::call, begin, {value});
        call->text = part;
        value = call;
      } else {
        return value;
      }
    }
  }

  NodePtr exponent() { return with_signs(&Parser::primary); }

  /// After "value(": a call when the value is a bare name (whether it is a function or an indexed
  /// matrix is known only to the binder), an index otherwise.
  NodePtr apply(std::size_t begin, const NodePtr& value) {
    std::vector<NodePtr> arguments;
    if (peek() != TokenKind::close) {
      do {
        arguments.push_back(argument());
      } while (accept(TokenKind::comma));
    }
    expect(TokenKind::close, "',' or ')'");
    if (value->kind == NodeKind::name) {
      auto call = make(NodeKind::call, begin, std::move(arguments));
      call->text = value->text;
      return call;
    }
    arguments.insert(arguments.begin(), value);
    return make(NodeKind::index, begin, std::move(arguments));
  }

  /// A lone ":", a range a:b, an index, a box, or a condition, of which a number is one.
  NodePtr argument() {
    const std::size_t begin = here().begin;
    if (accept(TokenKind::colon)) return make(NodeKind::range, begin, {});
    if (is_index() && here(2).kind == TokenKind::open_bracket) return box(begin);
    if (is_index()) {
      const Index found = index();
      auto each = make(NodeKind::each, begin, {found.low.root, found.high.root});
      each->text = found.name;
      return each;
    }
    NodePtr from = condition();
    if (!accept(TokenKind::colon)) return from;
    NodePtr to = comparison();
    return make(NodeKind::range, begin, {from, to});
  }

  /// x in [a, b]
  NodePtr box(std::size_t begin) {
    const std::string name = next().text;
    next();
    next();
    NodePtr low = sum();
    expect(TokenKind::comma, "',' between the ends of the box");
    NodePtr high = sum();
    expect(TokenKind::close_bracket, "']' after the ends of the box");
    auto within = make(NodeKind::within, begin, {low, high});
    within->text = name;
    return within;
  }

  NodePtr primary() {
    check_stop();
    const std::size_t begin = here().begin;
    switch (peek()) {
      case TokenKind::number:
      case TokenKind::name: {
        const Token& token = next();
        auto node =
            make(token.kind == TokenKind::number ? NodeKind::number : NodeKind::name, begin, {});
        node->text = token.text;
        return node;
      }
      case TokenKind::open: {
        next();
        NodePtr inner = condition();
        expect(TokenKind::close, "')'");
        return inner;
      }
      case TokenKind::open_bracket:
        next();
        return block(begin);
      case TokenKind::star:
        if (is_behind(TokenKind::star)) fail("write ^ for a power, not **");
        [[fallthrough]];
      default:
        fail("expected a number, a name, '(' or '[', found " + found());
    }
  }

  /// Rows with other numbers of entries are blocks of their own, above each other.
  NodePtr block(std::size_t begin) {
    const Depth depth(*this);
    std::vector<NodePtr> entries, rows;
    std::size_t columns = 0;
    bool ragged = false;
    for (;;) {
      const std::size_t row_begin = here().begin;
      std::vector<NodePtr> row;
      do {
        row.push_back(entry());
      } while (accept(TokenKind::comma));
      if (columns == 0) columns = row.size();
      ragged = ragged || row.size() != columns;
      entries.insert(entries.end(), row.begin(), row.end());
      rows.push_back(row.size() == 1 ? row.front() : table(row_begin, std::move(row)));
      if (accept(TokenKind::close_bracket)) break;
      if (!accept(TokenKind::semicolon))
        fail("expected ',' ';' or ']' in the block, found " + found() + missing());
    }
    if (!ragged) return table(begin, std::move(entries), columns);
    if (std::ranges::any_of(entries,
                            [](const NodePtr& entry) { return entry->kind == NodeKind::mirror; }))
      fail("the rows of a block with '*' have the same number of entries");
    return table(begin, std::move(rows), 1);
  }

  /// A block of these entries; one row where `columns` is 0.
  NodePtr table(std::size_t begin, std::vector<NodePtr> entries, std::size_t columns = 0) const {
    if (columns == 0) columns = entries.size();
    auto node = make(NodeKind::block, begin, std::move(entries));
    node->columns = static_cast<int>(columns);
    return node;
  }

  /// A "*" alone is the mirror of the entry across the diagonal.
  NodePtr entry() {
    const TokenKind after = here(1).kind;
    const bool alone = after == TokenKind::comma || after == TokenKind::semicolon ||
                       after == TokenKind::close_bracket;
    if (peek() == TokenKind::star && alone) {
      const std::size_t begin = next().begin;
      return make(NodeKind::mirror, begin, {});
    }
    return element();
  }

  int depth_ = 0;
};

Expression parsed(Text text, NodePtr (Parser::*read)()) {
  count_parsed();
  auto shared = std::make_shared<const Text>(std::move(text));
  NodePtr root = (Parser(shared).*read)();
  return {shared, root};
}

}  // namespace

Expression parse(Text text) { return parsed(std::move(text), &Parser::whole); }

Expression parse_element(Text text) { return parsed(std::move(text), &Parser::whole_element); }

Index parse_index(Text text) {
  return Parser(std::make_shared<const Text>(std::move(text))).whole_index();
}

Signature parse_signature(Text text) {
  return Parser(std::make_shared<const Text>(std::move(text))).signature();
}

}  // namespace gainsmith::expr
