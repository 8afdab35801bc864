#include "page/mathml.h"

#include <gtest/gtest.h>

#include "expr/binding/functions.h"
#include "io/yaml/problem_yaml.h"
#include "drawing/xml.h"

namespace gainsmith::page {
namespace {

/// Letters, numbers and operators, with the elements that place them: "msup(P −1)".
std::string plain(const std::string& markup) {
  std::string text;
  std::string_view rest = markup;
  while (!rest.empty()) {
    if (rest[0] != '<') {
      text += rest[0];
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t end = rest.find('>');
    std::string tag(rest.substr(1, end - 1));
    rest.remove_prefix(end + 1);
    for (const char* placed : {"msup", "msub", "mfrac", "mover", "munder", "msqrt"}) {
      if (tag == placed) text += tag + "(";
      if (tag == std::string("/") + placed) text += ")";
    }
    if (tag == "/mtd") text += " ";
    if (tag == "/mtr") text += ";";
  }
  // The invisible product.
  for (std::size_t at; (at = text.find("\u2062")) != std::string::npos;) text.erase(at, 3);
  for (const auto& [escape, sign] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}})
    for (std::size_t at; (at = text.find(escape)) != std::string::npos;) text.replace(at, 4, sign);
  return text;
}

expr::Expression expression(const std::string& text) { return expr::parse({text, "test.yaml"}); }

/// The markup is well-formed before it is made plain.
std::string checked(const std::string& markup) {
  EXPECT_TRUE(test::read_xml("<math>" + markup + "</math>")) << markup;
  return plain(markup);
}

Notation notation() {
  Notation notation;
  notation.functions = {"f", "Y", "P", "derivative"};
  notation.families = {"A", "P"};
  notation.scalars = {"alpha", "k", "T1"};
  notation.estimates = {{"xh", "x"}};
  return notation;
}

std::string shown(const std::string& text) { return checked(mathml(expression(text), notation())); }

TEST(MathMl, WritesProductsSumsAndPowersAsAPaper) {
  EXPECT_EQ(shown("2*alpha*Q"), "2αQ");
  EXPECT_EQ(shown("He(Q*B - R*C)"), "He(QB−RC)");
  EXPECT_EQ(shown("inv(Q)*R"), "msup(Q−1)R");
  EXPECT_EQ(shown("C'"), "msup(C⊤)");
  EXPECT_EQ(shown("x^2/(a + b)"), "mfrac(msup(x2)a+b)");
  EXPECT_EQ(shown("3*2"), "3·2");
  EXPECT_EQ(shown("-9.81*sin(x(1))"), "−9.81sin(msub(x1))");
  EXPECT_EQ(shown("B.*C"), "B∘C");
  EXPECT_EQ(shown("kron(B, C)"), "B⊗C");
}

TEST(MathMl, PutsParenthesesWhereTheTreeNeedsThem) {
  EXPECT_EQ(shown("(a + b)*c"), "(a+b)c");
  EXPECT_EQ(shown("a - (b - c)"), "a−(b−c)");
  EXPECT_EQ(shown("a - (b*c)"), "a−bc");
  EXPECT_EQ(shown("a - (-b)*c"), "a−(−bc)");
  EXPECT_EQ(shown("(a*b)^2"), "msup((ab)2)");
  EXPECT_EQ(shown("(a + b)'"), "msup((a+b)⊤)");
  EXPECT_EQ(shown("(a/b)^2"), "msup((mfrac(ab))2)");
  EXPECT_EQ(shown("-x^2"), "−msup(x2)");
  EXPECT_EQ(shown("(-x)^2"), "msup((−x)2)");
  EXPECT_EQ(shown("a*(b.*c)"), "a(b∘c)");
  EXPECT_EQ(shown("((((a))))"), "a");
}

TEST(MathMl, TellsMembersElementsAndValuesApart) {
  EXPECT_EQ(shown("A(i + 1)"), "msub(Ai+1)");
  EXPECT_EQ(shown("f(x, u)"), "f(x,u)");
  EXPECT_EQ(shown("Y(tau)"), "Y(τ)");
  EXPECT_EQ(shown("P(i)(s)"), "msub(Pi)(s)");
  EXPECT_EQ(shown("derivative(P(i))(s)"), "msup(msub(Pi)′)(s)");
  EXPECT_EQ(shown("z(2)"), "msub(z2)");
  EXPECT_EQ(shown("P1(2, :)"), "msub(P1,2,:)");
  EXPECT_EQ(shown("A(i)(1, 2)"), "msub(msub(Ai)1,2)");
  EXPECT_EQ(shown("xh + observer.xh"), "mover(x^)+observer.mover(x^)");
}

TEST(MathMl, HasTheNotationOfFunctions) {
  EXPECT_EQ(shown("norm(e)"), "‖e‖");
  EXPECT_EQ(shown("sqrt(a)"), "msqrt(a)");
  EXPECT_EQ(shown("exp(-alpha*t)"), "msup(e−αt)");
  EXPECT_EQ(shown("exp(a/b)"), "exp(mfrac(ab))");
  EXPECT_EQ(shown("sum(i in 1..N, trace(A(i)))"), "munder(∑i=1,…,N)tr(msub(Ai))");
  EXPECT_EQ(shown("maximum(z^2, z in [-1, 2])"), "munder(maxz∈[−1,2])msup(z2)");
  EXPECT_EQ(shown("jacobian(f(x), x)"), "mfrac(∂f(x)∂x)");
  EXPECT_EQ(shown("where(a > 0, 1, b)"), "1 if a>0 ;b otherwise ;");
  EXPECT_EQ(shown("[a, b; *, I]"), "a b ;⋆ I ;");
  EXPECT_EQ(shown("lambda_max(Q)"), "msub(λmax)(Q)");
  EXPECT_EQ(shown("project_affine(x, Q, B, b)"), "project_affine(x,Q,B,b)");
}

TEST(MathMl, ComparesMatricesAndNumbersDifferently) {
  const auto of = [](const std::string& text) {
    return checked(inequality_mathml(expression(text), notation()));
  };
  EXPECT_EQ(of("He(Q) < 0"), "He(Q)≺0");
  EXPECT_EQ(of("I <= Q <= k*I"), "I⪯Q⪯kI");
  EXPECT_EQ(of("norm(Q) <= 10"), "‖Q‖≤10");
  EXPECT_EQ(of("0 < T1 and Q > I"), "0<msub(T1)∧Q≻I");
  EXPECT_EQ(of("Q == R"), "Q=R");
  EXPECT_EQ(shown("He(Q) < 0"), "He(Q)<0");
}

TEST(MathMl, EveryNotationOfTheLanguageIsWellFormed) {
  for (const expr::Function& function : expr::functions()) {
    const std::string example(function.example);
    EXPECT_FALSE(shown(example).empty()) << example;
  }
  for (const expr::Operator& one : expr::operators())
    EXPECT_FALSE(shown(std::string(one.example)).empty()) << one.example;
}

TEST(MathMl, ADeepExpressionIsPrinted) {
  std::string text = "x";
  for (int k = 0; k < 90; ++k) text = "sin(" + text + ")";
  EXPECT_NE(shown(text).find("sin(sin("), std::string::npos);
}

TEST(MathMl, NamesOfAProblemAreRead) {
  const std::string text = R"yaml(problem: p
method:
  data: {A: {shape: n x n, for: i in 1..N}, f: {shape: n, of: {x: n}}, r: scalar}
  parameters: {alpha: 1}
  unknowns: {P: {shape: symmetric n, of: tau, degree: 1}}
  let: {twice: 2*alpha, E(s): expm(A(1)*s)}
  require: {flow: {forall: "tau in [0, 1]", that: P(tau) > I}}
  plant: {state: {x: n}, flow: {x: f(x)}}
  observer: {state: {xh: n}, flow: {xh: f(xh)}}
data: {A: [[[0]]], "f(x)": -x, r: 1}
)yaml";
  const io::MethodLibrary none{[](const std::string&) { return std::nullopt; }, {}};
  const Notation found = notation_of(io::parse_problem(text, "p.yaml", none));
  EXPECT_TRUE(found.functions.contains("f"));
  EXPECT_TRUE(found.functions.contains("P"));
  EXPECT_TRUE(found.functions.contains("E"));
  EXPECT_TRUE(found.families.contains("A"));
  EXPECT_TRUE(found.scalars.contains("twice"));
  EXPECT_FALSE(found.scalars.contains("P"));
  EXPECT_EQ(found.estimates.at("xh"), "x");
}

}  // namespace
}  // namespace gainsmith::page
