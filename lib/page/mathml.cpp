// Printing of expressions: each node becomes a piece of markup with the level of its outermost
// operation. A part whose level is looser than its place needs is put between parentheses.
#include "page/mathml.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/words.h"
#include "expr/binding/functions.h"
#include "page/element.h"
#include "page/symbol.h"

namespace gainsmith::page {

namespace {

using expr::Node;
using expr::NodeKind;
using expr::NodePtr;
using expr::Relation;

/// From the loosest to the tightest; a part of a tighter one needs parentheses.
enum class Level {
  condition,
  either,
  both,
  comparison,
  sum,
  sign,
  elementwise,
  product,
  power,
  atom
};

/// What is at an end of a piece: in a product words need room, and figures a dot.
enum class Edge { letter, word, figure };

struct Piece {
  std::string markup;
  Level level = Level::atom;
  Edge first = Edge::letter;
  Edge last = Edge::letter;
};

/// The markup, in parentheses where it is looser than `least`.
std::string enclosed(const Piece& piece, Level least) {
  return piece.level < least ? fenced(piece.markup) : piece.markup;
}

/// The edge of a symbol: long words touch no letter beside them.
Edge edge_of(std::string_view name) { return is_word(name) ? Edge::word : Edge::letter; }

/// Fractions and blocks are too tall for the raised place of an exponential.
bool is_flat(const Node& node) {
  if (node.kind == NodeKind::block || node.kind == NodeKind::divide) return false;
  for (const NodePtr& child : node.children)
    if (!is_flat(*child)) return false;
  return node.height <= 6;
}

/// Signs of numbers, or those of the Loewner order of symmetric matrices.
std::string relation_text(Relation relation, bool of_matrices) {
  constexpr auto kLast = Relation::not_equal;
  if (of_matrices) return word_of<kLast>(relation, {"≺", "⪯", "≻", "⪰", "=", "≠"});
  return word_of<kLast>(relation, {"<", "≤", ">", "≥", "=", "≠"});
}

/// Prints nodes. `of_matrices`: comparisons are orders of symmetric matrices unless a side is a
/// scalar.
class Printer {
 public:
  Printer(const Notation& notation, bool of_matrices)
      : notation_(notation), of_matrices_(of_matrices) {}

  Piece piece(const Node& node) const {
    switch (node.kind) {
      case NodeKind::number:
        return {number(node.text),
                node.text.find_first_of("eE") == std::string::npos ? Level::atom : Level::product,
                Edge::figure, Edge::figure};
      case NodeKind::name:
        return name(node.text);
      case NodeKind::call:
        return call(node);
      case NodeKind::index:
        return index(node);
      case NodeKind::range:
        return node.children.empty()
                   ? Piece{mo(":")}
                   : Piece{row(part(node, 0, Level::sum) + mo(":") + part(node, 1, Level::sum))};
      case NodeKind::negate:
        return {row(mo("−") + part(node, 0, Level::product)), Level::sign};
      case NodeKind::transpose:
        return raised(node, mo("⊤"));
      case NodeKind::power:
        return raised(node, inline_part(node, 1));
      case NodeKind::elementwise_power:
        return raised(node, row(mo("∘") + inline_part(node, 1)));
      case NodeKind::add:
        return {row(part(node, 0, Level::sum) + mo("+") + part(node, 1, Level::product)),
                Level::sum};
      case NodeKind::subtract:
        return {row(part(node, 0, Level::sum) + mo("−") + part(node, 1, Level::product)),
                Level::sum};
      case NodeKind::multiply:
        return product(node);
      case NodeKind::elementwise_multiply:
        return elementwise(node, "∘");
      case NodeKind::elementwise_divide:
        return elementwise(node, "⊘");
      case NodeKind::divide:
        return {element("mfrac", row(part(node, 0, Level::condition)) +
                                     row(part(node, 1, Level::condition))),
                Level::power};
      case NodeKind::block:
        return block(node);
      case NodeKind::mirror:
        return {mo("⋆")};
      case NodeKind::each:
        return {row(name(node.text).markup + mo("=") + part(node, 0, Level::sum) + mo(",") +
                    mo("…") + mo(",") + part(node, 1, Level::sum))};
      case NodeKind::within:
        return {
            row(name(node.text).markup + mo("∈") +
                fenced(part(node, 0, Level::sum) + mo(",") + part(node, 1, Level::sum), "[", "]"))};
      case NodeKind::compare:
        return comparison(node);
      case NodeKind::conjunction:
        return joined(node, "∧", Level::both);
      case NodeKind::disjunction:
        return joined(node, "∨", Level::either);
      case NodeKind::negation:
        return {row(mo("¬") + part(node, 0, Level::sum)), Level::both};
    }
    return {};
  }

  Piece name(const std::string& text) const { return with_indices(text, {}); }

 private:
  /// A child, in parentheses where it is looser than `least`.
  std::string part(const Node& node, std::size_t child, Level least) const {
    return enclosed(piece(*node.children[child]), least);
  }

  /// Of a raised place.
  std::string inline_part(const Node& node, std::size_t child) const {
    return row(part(node, child, Level::condition));
  }

  /// A name with further indices. "observer.xh" keeps its component; an estimate gets its hat.
  Piece with_indices(const std::string& text, const std::vector<std::string>& below) const {
    if (const std::size_t dot = text.rfind('.'); dot != std::string::npos)
      return {row(text_element("mi", text.substr(0, dot)) + mo(".") +
                  with_indices(text.substr(dot + 1), below).markup),
              Level::atom, Edge::word};
    const auto estimate = notation_.estimates.find(text);
    if (estimate != notation_.estimates.end())
      return {hatted(estimate->second, below), Level::atom, edge_of(estimate->second)};
    const Edge edge = edge_of(text);
    return {symbol(text, below), Level::atom, edge, edge};
  }

  /// The children from one on, as operands of a list.
  std::vector<std::string> parts(const Node& node, std::size_t from) const {
    std::vector<std::string> found;
    for (std::size_t k = from; k < node.children.size(); ++k)
      found.push_back(part(node, k, Level::condition));
    return found;
  }

  /// f(a, b)
  std::string applied(const std::string& function, const Node& node, std::size_t from) const {
    return row(function + fenced(listed(parts(node, from))));
  }

  /// The first child to a power or with a sign of that place: ⊤, -1, +.
  Piece raised(const Node& node, const std::string& above) const {
    const Piece base = piece(*node.children[0]);
    return {element("msup", row(enclosed(base, Level::atom)) + above), Level::power, base.first};
  }

  /// A product has no sign: a dot before a figure, a space beside a word. A sign at its left needs
  /// no parentheses: -a b.
  Piece product(const Node& node) const {
    const Piece left = piece(*node.children[0]);
    const Piece right = piece(*node.children[1]);
    // Parentheses of the right factor keep the two apart already.
    const bool fences = right.level < Level::product;
    std::string between = "<mo>\u2062</mo>";
    if (!fences && right.first == Edge::figure)
      between = mo("·");
    else if (!fences && (left.last == Edge::word || right.first == Edge::word))
      between = R"(<mspace width="0.2em"/>)";
    // -a times b is -(a b), which needs no parentheses.
    const bool has_sign = left.level == Level::sign;
    return {row((has_sign ? left.markup : enclosed(left, Level::product)) + between +
                enclosed(right, Level::product)),
            has_sign ? Level::sign : Level::product, left.first, right.last};
  }

  /// a ∘ b and a ⊘ b, which are looser than products and tighter than sums.
  Piece elementwise(const Node& node, std::string_view sign) const {
    return {row(part(node, 0, Level::elementwise) + mo(sign) + part(node, 1, Level::product)),
            Level::elementwise};
  }

  /// Children are row by row.
  Piece block(const Node& node) const {
    const int columns = node.columns;
    const int rows = static_cast<int>(node.children.size()) / std::max(columns, 1);
    return {table(rows, columns, [&](int i, int j) {
      return part(node, static_cast<std::size_t>(i * columns + j), Level::condition);
    })};
  }

  /// A chain a < b <= c. In an inequality of matrices its signs are those of the Loewner order.
  Piece comparison(const Node& node) const {
    // A literal, such as the 0 of P > 0, says nothing of the other side.
    bool numbers = !of_matrices_;
    for (const NodePtr& child : node.children)
      numbers = numbers || (child->kind != NodeKind::number && is_scalar(*child, notation_));
    std::string markup = part(node, 0, Level::sum);
    for (std::size_t k = 0; k < node.relations.size(); ++k)
      markup += mo(relation_text(node.relations[k], !numbers)) + part(node, k + 1, Level::sum);
    return {row(markup), Level::comparison};
  }

  /// Conditions with "and" or "or" between them.
  Piece joined(const Node& node, std::string_view word, Level level) const {
    std::string markup;
    for (std::size_t k = 0; k < node.children.size(); ++k)
      markup += (k == 0 ? "" : mo(word)) + part(node, k, level);
    return {row(markup), level};
  }

  /// Whether the call gives a function, which the brackets behind it apply.
  bool is_function(const Node& node) const {
    if (node.kind != NodeKind::call) return false;
    return node.text == "derivative" ||
           (notation_.functions.contains(node.text) && notation_.families.contains(node.text));
  }

  /// P(i)(s), derivative(Y)(tau), or an element (A*B)(1, 2).
  Piece index(const Node& node) const {
    const Node& of = *node.children[0];
    if (is_function(of)) return {applied(piece(of).markup, node, 1)};
    return {element("msub", row(part(node, 0, Level::atom)) + row(listed(parts(node, 1))))};
  }

  /// A member of a family has its index below; a function is applied; what is neither is an
  /// element.
  Piece call(const Node& node) const {
    const std::string& text = node.text;
    if (notation_.families.contains(text)) return with_indices(text, parts(node, 0));
    if (text == "derivative") return {element("msup", row(part(node, 0, Level::atom)) + mo("′"))};
    if (notation_.functions.contains(text)) {
      const Edge edge = edge_of(text);
      return {applied(name(text).markup, node, 0), Level::atom, edge};
    }
    if (const std::optional<Piece> known = built_in(node)) return *known;
    return with_indices(text, parts(node, 0));
  }

  /// The functions that have a notation of their own.
  std::optional<Piece> built_in(const Node& node) const {
    if (expr::find_function(node.text) == nullptr) return std::nullopt;
    for (const Fences& fences : kFences)
      if (fences.name == node.text && node.children.size() == 1)
        return Piece{fenced(part(node, 0, Level::condition), fences.open, fences.close)};
    for (const Raised& one : kRaised)
      if (one.name == node.text) return raised(node, one.above());
    for (const auto& [known, print] : kSpecial)
      if (known == node.text)
        if (std::optional<Piece> piece = (this->*print)(node)) return piece;
    std::string word = text_element("mi", node.text);
    for (const auto& [known, shown] : kWords)
      if (known == node.text) word = symbol(shown);
    return Piece{applied(word, node, 0), Level::atom, Edge::word};
  }

  /// e with a raised argument; none where it is too tall, which leaves exp( ).
  std::optional<Piece> exponential(const Node& node) const {
    if (!is_flat(*node.children[0])) return std::nullopt;
    return Piece{element("msup", "<mi>e</mi>" + inline_part(node, 0)), Level::power};
  }

  std::optional<Piece> root(const Node& node) const {
    return Piece{element("msqrt", part(node, 0, Level::condition))};
  }

  /// I, 1 or 0 with its size below.
  std::optional<Piece> sized(const Node& node) const {
    std::string sizes;
    for (const std::string& size : parts(node, 0)) sizes += (sizes.empty() ? "" : mo("×")) + size;
    const std::string letter = node.text == "eye"    ? "<mi>I</mi>"
                               : node.text == "ones" ? "<mn>1</mn>"
                                                     : "<mn>0</mn>";
    return Piece{element("msub", letter + row(sizes))};
  }

  /// a ⊗ b, which binds like a product.
  std::optional<Piece> kronecker(const Node& node) const {
    return Piece{row(part(node, 0, Level::product) + mo("⊗") + part(node, 1, Level::power)),
                 Level::product};
  }

  /// Of a sum or a maximum: what runs, below the sign.
  std::optional<Piece> over(const Node& node) const {
    std::vector<std::string> runs;
    std::string of;
    for (std::size_t k = 0; k < node.children.size(); ++k) {
      const NodeKind kind = node.children[k]->kind;
      if (kind == NodeKind::each || kind == NodeKind::within)
        runs.push_back(part(node, k, Level::condition));
      else
        of = part(node, k, Level::product);
    }
    if (runs.empty()) return std::nullopt;
    const std::string sign = node.text == "sum"       ? mo("∑")
                             : node.text == "maximum" ? mo("max")
                                                      : mo("min");
    return Piece{row(element("munder", sign + row(listed(runs))) + of), Level::sum};
  }

  /// jacobian(f, x) as the fraction ∂f / ∂x.
  std::optional<Piece> derivative(const Node& node) const {
    return Piece{element("mfrac", row(mo("∂") + part(node, 0, Level::product)) +
                                      row(mo("∂") + part(node, 1, Level::atom))),
                 Level::power};
  }

  /// where(c, a, b) as two lines: a if c, b otherwise.
  std::optional<Piece> cases(const Node& node) const {
    const auto line = [&](const std::string& what, const std::string& when) {
      return element("mtr",
                     element("mtd", what, R"(class="l")") + element("mtd", when, R"(class="l")"));
    };
    return Piece{row(element("mtable",
                             line(part(node, 1, Level::condition),
                                  row("<mtext>if </mtext>" + part(node, 0, Level::condition))) +
                                 line(part(node, 2, Level::condition), "<mtext>otherwise</mtext>"),
                             R"(class="c")")),
                 Level::sum};
  }

  /// Functions of one argument that are written between signs.
  struct Fences {
    std::string_view name, open, close;
  };
  static constexpr std::array kFences = {Fences{"norm", "‖", "‖"}, Fences{"abs", "|", "|"},
                                         Fences{"floor", "⌊", "⌋"}, Fences{"ceil", "⌈", "⌉"}};

  /// Functions that are written as a power.
  struct Raised {
    std::string_view name;
    std::string (*above)();
  };
  static constexpr std::array kRaised = {Raised{"inv", [] { return row(mo("−") + "<mn>1</mn>"); }},
                                         Raised{"pinv", [] { return mo("+"); }}};

  /// Functions with a printer of their own; where it gives none, they are printed as f(a, b).
  using Special = std::optional<Piece> (Printer::*)(const Node&) const;
  static constexpr std::array<std::pair<std::string_view, Special>, 12> kSpecial = {{
      {"exp", &Printer::exponential},
      {"expm", &Printer::exponential},
      {"sqrt", &Printer::root},
      {"eye", &Printer::sized},
      {"zeros", &Printer::sized},
      {"ones", &Printer::sized},
      {"kron", &Printer::kronecker},
      {"sum", &Printer::over},
      {"maximum", &Printer::over},
      {"minimum", &Printer::over},
      {"jacobian", &Printer::derivative},
      {"where", &Printer::cases},
  }};

  /// Functions that mathematics calls otherwise.
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kWords = {
      {{"trace", "tr"}, {"log", "ln"}, {"lambda_max", "lambda_max"}, {"lambda_min", "lambda_min"}}};

  const Notation& notation_;
  bool of_matrices_;
};

std::string printed(const expr::Expression& expression, const Notation& notation,
                    bool of_matrices) {
  if (!expression.root) return "";
  return Printer(notation, of_matrices).piece(*expression.root).markup;
}

}  // namespace

std::string mathml(const expr::Expression& expression, const Notation& notation) {
  return printed(expression, notation, false);
}

std::string inequality_mathml(const expr::Expression& expression, const Notation& notation) {
  return printed(expression, notation, true);
}

std::string name_mathml(const std::string& name, const Notation& notation) {
  return Printer(notation, false).name(name).markup;
}

std::string signature_mathml(const expr::Signature& signature, const Notation& notation) {
  std::vector<std::string> below;
  for (const expr::Index& index : signature.indices) below.push_back(symbol(index.name));
  std::string markup =
      below.empty() ? name_mathml(signature.name, notation) : symbol(signature.name, below);
  if (signature.parameters.empty()) return markup;
  std::vector<std::string> parameters;
  for (const std::string& parameter : signature.parameters)
    parameters.push_back(name_mathml(parameter, notation));
  return row(markup + fenced(listed(parameters)));
}

std::string index_mathml(const expr::Index& index, const Notation& notation) {
  return row(symbol(index.name) + mo("=") + mathml(index.low, notation) + mo(",") + mo("…") +
             mo(",") + mathml(index.high, notation));
}

}  // namespace gainsmith::page
