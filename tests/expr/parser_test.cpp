#include "expr/text/parser.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

/// The tree in prefix form: "(+ a (* b c))".
std::string tree(const Node& node) {
  const auto list = [&](const std::string& head) {
    std::string text = "(" + head;
    for (const NodePtr& child : node.children) text += " " + tree(*child);
    return text + ")";
  };
  switch (node.kind) {
    case NodeKind::number:
    case NodeKind::name:
      return node.text;
    case NodeKind::call:
      return list(node.text + "()");
    case NodeKind::index:
      return list("index");
    case NodeKind::range:
      return node.children.empty() ? ":" : list(":");
    case NodeKind::negate:
      return list("neg");
    case NodeKind::transpose:
      return list("'");
    case NodeKind::add:
      return list("+");
    case NodeKind::subtract:
      return list("-");
    case NodeKind::multiply:
      return list("*");
    case NodeKind::divide:
      return list("/");
    case NodeKind::power:
      return list("^");
    case NodeKind::elementwise_multiply:
      return list(".*");
    case NodeKind::elementwise_divide:
      return list("./");
    case NodeKind::elementwise_power:
      return list(".^");
    case NodeKind::block:
      return list("block" + std::to_string(node.columns));
    case NodeKind::mirror:
      return "*";
    case NodeKind::each:
      return list("each " + node.text);
    case NodeKind::within:
      return list("within " + node.text);
    case NodeKind::compare: {
      std::string text = "(compare " + tree(*node.children[0]);
      for (std::size_t i = 0; i < node.relations.size(); ++i)
        text += " " + to_string(node.relations[i]) + " " + tree(*node.children[i + 1]);
      return text + ")";
    }
    case NodeKind::conjunction:
      return list("and");
    case NodeKind::disjunction:
      return list("or");
    case NodeKind::negation:
      return list("not");
  }
  return "?";
}

std::string tree(const std::string& text) { return tree(*parse({text, "f"}).root); }

TEST(Parser, ConditionsBindLooserThanComparisons) {
  EXPECT_EQ(tree("a > 0 and b <= c or not c < 1"),
            "(or (and (compare a > 0) (compare b <= c)) (not (compare c < 1)))");
  EXPECT_EQ(tree("not a == 1 and not (b == 1 or c == 1)"),
            "(and (not (compare a == 1)) (not (or (compare b == 1) (compare c == 1))))");
  EXPECT_EQ(tree("where(q == 1 and x > 0, a, b)"),
            "(where() (and (compare q == 1) (compare x > 0)) a b)");
}

TEST(Parser, ANameMayBeThatOfAPart) {
  EXPECT_EQ(tree("plant.x(1) + toggled.xh.^2"), "(+ (plant.x() 1) (.^ toggled.xh 2))");
}

TEST(Parser, BindsAsMatlabDoes) {
  EXPECT_EQ(tree("a + b*c"), "(+ a (* b c))");
  EXPECT_EQ(tree("a - b - c"), "(- (- a b) c)");
  EXPECT_EQ(tree("a/b*c"), "(* (/ a b) c)");
  EXPECT_EQ(tree("A'^2"), "(^ (' A) 2)");
  EXPECT_EQ(tree("A^2'"), "(' (^ A 2))");
  EXPECT_EQ(tree("-x^2"), "(neg (^ x 2))");
  EXPECT_EQ(tree("2^-1"), "(^ 2 (neg 1))");
  EXPECT_EQ(tree("2^-1*3"), "(* (^ 2 (neg 1)) 3)");
  EXPECT_EQ(tree("2^3^4"), "(^ (^ 2 3) 4)");
  EXPECT_EQ(tree("-a*b"), "(* (neg a) b)");
  EXPECT_EQ(tree("a.*b*c./d"), "(./ (* (.* a b) c) d)");
  EXPECT_EQ(tree("a + 2.*b"), "(+ a (.* 2 b))");
  EXPECT_EQ(tree("-x.^2.*y"), "(.* (neg (.^ x 2)) y)");
  EXPECT_EQ(tree("x.^-2'"), "(' (.^ x (neg 2)))");
  EXPECT_EQ(tree("x.^2^3"), "(^ (.^ x 2) 3)");
  EXPECT_EQ(tree("a*-b"), "(* a (neg b))");
  EXPECT_EQ(tree("a - -b"), "(- a (neg b))");
  EXPECT_EQ(tree("+a"), "a");
  EXPECT_EQ(tree("-A'"), "(neg (' A))");
  EXPECT_EQ(tree("A''"), "(' (' A))");
  EXPECT_EQ(tree("(a + b)*c"), "(* (+ a b) c)");
  EXPECT_EQ(tree("x(1)'"), "(' (x() 1))");
  EXPECT_EQ(tree("x'(1)"), "(index (' x) 1)");
  EXPECT_EQ(tree("x(1)^2"), "(^ (x() 1) 2)");
}

TEST(Parser, ComparisonsBindLoosestAndChain) {
  EXPECT_EQ(tree("0 < a + b <= c"), "(compare 0 < (+ a b) <= c)");
  EXPECT_EQ(tree("a > b >= c"), "(compare a > b >= c)");
}

TEST(Parser, CallsIndicesAndRanges) {
  EXPECT_EQ(tree("f(a, b + 1)"), "(f() a (+ b 1))");
  EXPECT_EQ(tree("f()"), "(f())");
  EXPECT_EQ(tree("A(:, 2:n)"), "(A() : (: 2 n))");
  EXPECT_EQ(tree("(A*B)(1, 2)"), "(index (* A B) 1 2)");
  EXPECT_EQ(tree("f(x)(1)"), "(index (f() x) 1)");
  EXPECT_EQ(tree("where(a > b, x, y)"), "(where() (compare a > b) x y)");
}

TEST(Parser, ATightSignAfterASpaceIsNoDifferenceInABlock) {
  for (const char* text : {"[1 -1; 2, 3]", "[a +b]", "[f(x) -1]"})
    EXPECT_NE(input_error([&] {
                parse({text, "f"});
              })
                  .message()
                  .find("a comma is missing before"),
              std::string::npos)
        << text;
  for (const char* text :
       {"[1 - 1; 2]", "[1-1]", "[1, -1]", "[(a -b)]", "[f(a -b)]", "[1 -\n1]", "a -b"})
    EXPECT_NO_THROW(parse({text, "f"})) << text;
  EXPECT_NE(input_error([&] {
              parse_element({"-1 -2", "f"});
            })
                .message()
                .find("a comma is missing"),
            std::string::npos);
}

TEST(Parser, BlocksNestAndMirror) {
  EXPECT_EQ(tree("[a, b; *, c]"), "(block2 a b * c)");
  EXPECT_EQ(tree("[a*b, *; c, *]"), "(block2 (* a b) * c *)");
  EXPECT_EQ(tree("[[a, b]; c]"), "(block1 (block2 a b) c)");
  EXPECT_EQ(tree("[a]"), "(block1 a)");
  EXPECT_EQ(tree("[a;\n b]'"), "(' (block1 a b))");
}

TEST(Parser, MistakesAreShownWhereTheyAre) {
  struct Case {
    std::string text;
    int line;
    int column;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"", 1, 1, "expected an expression, found nothing"},
      {"a +", 1, 4, "the end of the text"},
      {"a + * b", 1, 5, "found '*'"},
      {"a b", 1, 3, "found 'b'"},
      {"(a + b", 1, 7, "expected ')'"},
      {"a)", 1, 2, "found ')'"},
      {"[a, b; *]", 1, 10, "have the same number of entries"},
      {"[a, b\n c]", 2, 2, "expected ',' ';' or ']'"},
      {"[]", 1, 2, "found ']'"},
      {"[a, ]", 1, 5, "found ']'"},
      {"f(a,)", 1, 5, "found ')'"},
      {"f(a; b)", 1, 4, "found ';'"},
      {"a**b", 1, 3, "write ^ for a power"},
      {"2 3", 1, 3, "found '3'"},
      {"1.2.3", 1, 4, "found '.3'"},
      {"a <", 1, 4, "the end of the text"},
      {"a\n+ b\n+ )", 3, 3, "found ')'"},
      {"[a, b < c]", 1, 7, "found '<'"},
      {"a:b", 1, 2, "found ':'"},
      {"a^", 1, 3, "the end of the text"},
  };
  for (const Case& expected : cases) {
    const InputError error = input_error([&] { parse({expected.text, "f"}); });
    EXPECT_EQ(error.place(), (Place{"f", expected.line, expected.column}))
        << expected.text << ": " << error.what();
    EXPECT_NE(error.message().find(expected.message), std::string::npos)
        << expected.text << ": " << error.what();
  }
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(Parser, NestingThatWouldExhaustTheStackIsRefused) {
  constexpr int kDeep = 100000;
  for (const std::string& text :
       {repeated("(", kDeep), repeated("[", kDeep), repeated("-", kDeep) + "x",
        repeated("f(", kDeep), "x" + repeated("'", kDeep), "x" + repeated("^2", kDeep),
        "x" + repeated("+x", kDeep), "x" + repeated("*x", kDeep), "x^" + repeated("-", kDeep),
        "x" + repeated("(1)", kDeep)}) {
    const InputError error = input_error([&] { parse({text, "f"}); });
    EXPECT_NE(error.message().find("nested too deeply"), std::string::npos)
        << text.substr(0, 10) << ": " << error.what();
  }
}

TEST(Parser, FormulasOfOrdinaryLengthAreNotRefused) {
  parse({"x" + repeated(" + x", 300), "f"});
  parse({repeated("(", 90) + "x" + repeated(")", 90), "f"});
  parse({"[x" + repeated(", x", 5000) + "]", "f"});
}

TEST(Signature, IsANameWithOrWithoutParameters) {
  const Signature plain = parse_signature({"mu", "f"});
  EXPECT_EQ(plain.name, "mu");
  EXPECT_TRUE(plain.parameters.empty());
  const Signature two = parse_signature({"f(a, b2)", "f"});
  EXPECT_EQ(two.name, "f");
  EXPECT_EQ(two.parameters, (std::vector<std::string>{"a", "b2"}));
}

TEST(Signature, MistakesAreShownWhereTheyAre) {
  const std::vector<std::pair<std::string, int>> cases = {{"", 1},     {"1", 1},   {"f(", 3},
                                                          {"f()", 3},  {"f(a", 4}, {"f(a, a)", 6},
                                                          {"f(1)", 3}, {"a b", 3}, {"f(a) b", 6}};
  for (const auto& [text, column] : cases) {
    const InputError error = input_error([&] { parse_signature({text, "f"}); });
    EXPECT_EQ(error.place(), (Place{"f", 1, column})) << text << ": " << error.what();
  }
}

TEST(Names, AreThoseOfValuesFunctionsAndDefinitions) {
  EXPECT_EQ(names_in(parse({"f(a) + b'*[c, 2; *, I]", "f"})),
            (std::set<std::string>{"f", "a", "b", "c", "I"}));
}

TEST(Quote, IsTheSourceOfTheNodeOnOneLineAndShort) {
  const Expression expression = parse({"a +\n(b*c)", "f"});
  EXPECT_EQ(expression.quote(*expression.root), "a + (b*c)");
  const Expression lengthy = parse({"a" + repeated(" + a", 30), "f"});
  const std::string quoted = lengthy.quote(*lengthy.root);
  EXPECT_EQ(quoted.size(), 40U);
  EXPECT_EQ(quoted.substr(37), "...");
}

}  // namespace
}  // namespace gainsmith::expr
