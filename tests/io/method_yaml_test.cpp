#include "io/yaml/method_yaml.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/problem_text.h"
#include "io/yaml/method_node.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

TEST(Method, IsReadWhole) {
  const model::Method method = parse_method(kMethod, "m.yaml");
  EXPECT_EQ(method.name, "small");
  EXPECT_EQ(method.file, "m.yaml");
  EXPECT_EQ(method.text, kMethod);
  ASSERT_EQ(method.data.size(), 2U);
  EXPECT_FALSE(method.data[0].fallback);
  EXPECT_TRUE(method.data[1].fallback);
  EXPECT_EQ(method.data[1].help, "a column");
  EXPECT_TRUE(method.data[1].shape.is_column());
  ASSERT_EQ(method.parameters.size(), 2U);
  EXPECT_EQ(method.parameters[1].fallback->text->str(), "2");
  ASSERT_EQ(method.let.size(), 1U);
  EXPECT_EQ(method.let[0].signature.parameters, std::vector<std::string>{"tau"});
  ASSERT_EQ(method.require.size(), 2U);
  ASSERT_EQ(method.require[1].forall.size(), 1U);
  EXPECT_EQ(method.require[1].forall[0].over, model::Over::interval);
  EXPECT_EQ(method.require[1].place, (Place{"m.yaml", 17, 3}));
  ASSERT_EQ(method.events.size(), 1U);
  const model::EventText& timer = method.events.front();
  EXPECT_EQ(timer.kind, model::Dynamics::EventKind::every);
  EXPECT_EQ(timer.left, model::timer_name(method));
  EXPECT_EQ(timer.first.back().text->str(), "2") << "first is like reset when left out";
  ASSERT_EQ(method.claims.size(), 3U);
  EXPECT_EQ(method.claims[1].kind, model::ClaimKind::cost);
  EXPECT_TRUE(method.claims[1].flow_cost);
  EXPECT_FALSE(method.claims[1].jump_cost);
  EXPECT_EQ(method.claims[2].kind, model::ClaimKind::shrinks);
}

model::Forall forall(const std::string& text) { return parse_forall({text, "f"}); }

TEST(Forall, IsAnIntervalOrASet) {
  const model::Forall interval = forall("tau in [0, max(T1, T2)]");
  EXPECT_EQ(interval.variable, "tau");
  EXPECT_EQ(interval.over, model::Over::interval);
  ASSERT_EQ(interval.points.size(), 2U);
  EXPECT_EQ(interval.points[1].text->str(), " max(T1, T2)");
  const model::Forall set = forall("s in  {1, 2*(3), A(1, 2)} ");
  EXPECT_EQ(set.over, model::Over::set);
  EXPECT_EQ(set.points.size(), 3U);
  EXPECT_EQ(forall("s in {0}").points.size(), 1U);
}

TEST(Forall, MistakesAreShownWhereTheyAre) {
  const std::vector<std::pair<std::string, int>> cases = {{"tau", 1},
                                                          {"", 1},
                                                          {"tau in", 1},
                                                          {"tau in ", 4},
                                                          {"tau in [0]", 8},
                                                          {"tau in [0, 1, 2]", 8},
                                                          {"tau in (0, 1)", 8},
                                                          {"tau in [0, 1}", 8},
                                                          {"tau in {}", 9},
                                                          {"tau in {1,}", 11},
                                                          {"f(x) in [0, 1]", 1},
                                                          {"1 in [0, 1]", 1},
                                                          {"tau in [0, +]", 13},
                                                          {"tau in [0, 1", 8}};
  for (const auto& [text, column] : cases) {
    const InputError error = input_error([&] { forall(text); });
    EXPECT_EQ(error.place(), (Place{"f", 1, column})) << text << ": " << error.what();
  }
}

/// What stands under "a:" of the requirements.
model::Requirement required(const std::string& text) {
  return parse_method("method: m\nunknowns: {P: symmetric n}\nrequire:\n  a:\n" + text, "m.yaml")
      .require.at(0);
}

TEST(NamedBlocks, AreTheBlockMatrixOfTheirRows) {
  const model::Requirement named = required(
      "    blocks:\n      x: {x: He(P), w: P*B}\n      w: {w: -g*I}\n"
      "      z: {x: \"[C; D]\", z: -I}\n    is: < 0\n    forall: i in 1..N\n");
  EXPECT_EQ(named.that.text->str(), "[(He(P)),(P*B),([C; D])';*,(-g*I),0;*,*,(-I)]< 0");
  EXPECT_EQ(named.indices.size(), 1U);
  const Place place = named.that.text->place(named.that.text->str().find("P*B"));
  EXPECT_EQ(place, (Place{"m.yaml", 6, 24}));
  // A column without a row of its own has one that is zero but for it.
  EXPECT_EQ(required("    blocks: {x: {x: P, y: b}}\n    is: \">= 0\"\n").that.text->str(),
            "[P,b;*,0]>= 0");
}

TEST(NamedBlocks, MistakesAreShownWhereTheyAre) {
  const auto expect = [](const std::string& text, int line, const std::string& part) {
    const InputError error = input_error([&] { required(text); });
    EXPECT_EQ(error.place().line, line) << text << error.what();
    EXPECT_NE(error.message().find(part), std::string::npos) << error.what();
  };
  expect("    blocks: {x: {x: P}}\n", 5, "need both");
  expect("    is: < 0\n", 5, "need both");
  expect("    blocks: {x: {x: P}}\n    is: P\n", 6, "comparison with 0");
  expect("    blocks: {x: {x: P}}\n    is: < 0\n    that: P > 0\n", 7, "not both");
  expect("    blocks: {x: {y: P}, y: {x: P}}\n    is: < 0\n", 5, "one of them is enough");
}

TEST(FamilyTexts, HaveIndicesAndConditions) {
  const model::Requirement pairs =
      required("    forall: [i in 1..N, j in 1..N, i != j, \"t in [0, 1]\"]\n    that: P > 0\n");
  EXPECT_EQ(pairs.indices.size(), 2U);
  EXPECT_EQ(pairs.conditions.size(), 1U);
  EXPECT_EQ(pairs.forall.size(), 1U);
  EXPECT_TRUE(required("    forall: h in v\n    that: P > 0\n").forall.at(0).of_vector);
  EXPECT_NE(input_error([] { required("    forall: i != j\n    that: P > 0\n"); })
                .message()
                .find("there are none here"),
            std::string::npos);
}

class BrokenMethod : public testing::TestWithParam<Mistake> {};

TEST_P(BrokenMethod, IsRefusedAtItsPlace) {
  const Mistake& mistake = GetParam();
  const std::string text = replaced(kMethod, mistake.from, mistake.to);
  const InputError error = input_error([&] { parse_method(text, "m.yaml"); });
  const Place place =
      mistake.line == 0 ? Place{"m.yaml"} : Place{"m.yaml", mistake.line, mistake.column};
  EXPECT_EQ(error.place(), place) << mistake.to << ": " << error.what();
  EXPECT_NE(error.message().find(mistake.message), std::string::npos) << error.what();
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BrokenMethod,
    testing::Values(Mistake{"method: small", "metod: small", 1, 1, "did you mean 'method'?"},
                    Mistake{"summary:", "summery:", 3, 1, "did you mean 'summary'?"},
                    Mistake{"unknowns:", "unknows:", 12, 1, "did you mean 'unknowns'?"},
                    Mistake{"require:", "requires:", 15, 1, "did you mean 'require'?"},
                    Mistake{"forall:", "for_all:", 18, 5, "did you mean 'forall'?"},
                    Mistake{"that:", "taht:", 19, 5, "did you mean 'that'?"},
                    Mistake{"shape: n,", "shap: n,", 6, 7, "did you mean 'shape'?"},
                    Mistake{"help: decay", "hlep: decay", 8, 25, "did you mean 'help'?"},
                    Mistake{"state:", "stat:", 24, 3, "did you mean 'state'?"},
                    Mistake{"reset:", "rest:", 28, 9, "did you mean 'reset'?"},
                    Mistake{"nonincreasing:", "nonincraesing:", 32, 11,
                            "did you mean 'nonincreasing'?"},
                    Mistake{"below:", "bellow:", 33, 30, "did you mean 'below'?"},
                    Mistake{"{flow: w^2}", "{flaw: w^2}", 33, 18, "did you mean 'flow'?"},
                    Mistake{", to: 0.1", "", 34, 10, "the key 'to' is missing"}));

INSTANTIATE_TEST_SUITE_P(
    Values, BrokenMethod,
    testing::Values(Mistake{"A: n x n", "A: n x", 5, 9, "expected"},
                    Mistake{"A: n x n", "A: symmetric", 5, 6, "symmetric n"},
                    Mistake{"A: n x n", "A: scaler", 5, 6, "did you mean 'scalar'?"},
                    Mistake{"A: n x n", "A: symetric n", 5, 6, "did you mean 'symmetric'?"},
                    Mistake{"A: n x n", "A: [n, n]", 5, 6, "expected a shape, such as n x p"},
                    Mistake{"A: n x n", "A:", 5, 5, "found nothing"},
                    Mistake{"A: n x n", "2A: n x n", 5, 3, "'2A' is no name"},
                    Mistake{"A: n x n", "A B: n x n", 5, 3, "'A B' is no name"},
                    Mistake{"  mu(tau)", "  mu(", 14, 6, "parameter"},
                    Mistake{"P > 0", "P >", 16, 16, "the end of the text"},
                    Mistake{"tau in [0, 1]", "tau of [0, 1]", 18, 13, "expected 'NAME in"},
                    Mistake{"[1, 2]}", "[1]}", 28, 16, "expected [low, high]"},
                    Mistake{"[1, 2]}", "1}", 28, 16, "expected [low, high]"},
                    Mistake{"tau: {reset", "s: {reset: [1, 2]}\n  tau: {reset", 27, 1, "one timer"},
                    Mistake{"{nonincreasing: z'*P*z}", "{}", 32, 3, "needs one of"},
                    Mistake{"{nonincreasing: z'*P*z}", "{nonincreasing: 1, shrinks: 2}", 32, 3,
                            "needs exactly one of"}));

INSTANTIATE_TEST_SUITE_P(
    Names, BrokenMethod,
    testing::Values(Mistake{"  rate: 2", "  A: 2", 9, 3, "already names a datum"},
                    Mistake{"  rate: 2", "  exp: 2", 9, 3, "word of the language"},
                    Mistake{"  rate: 2", "  I: 2", 9, 3, "word of the language"},
                    Mistake{"  rate: 2", "  n: 2", 9, 3, "dimension"},
                    Mistake{"g: scalar", "rate: scalar", 12, 28, "already names a parameter"},
                    Mistake{"  mu(tau)", "  P(tau)", 14, 3, "already names an unknown"},
                    Mistake{"{z: n}", "{P: n}", 26, 10, "the flow of 'z', which is no state"},
                    Mistake{"{y: b'*z}", "{z: b'*z}", 25, 12, "already names a state"},
                    Mistake{"flow: {z: A*z}", "flow: {y: A*z}", 26, 10, "'y', which is no state"},
                    Mistake{"  w: 2*y", "  y: 2", 30, 3, "already names an output"},
                    Mistake{"  K: b'*P", "  w: b'*P", 30, 3, "already names a gain"},
                    Mistake{"forall: tau in", "forall: rate in", 18, 13,
                            "already names a parameter"}));

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenMethod,
    testing::Values(Mistake{kMethod, "", 0, 0, "empty"},
                    Mistake{kMethod, "method: a\n---\nmethod: b\n", 2, 1, "second"},
                    Mistake{"summary:", "summary: [", 3, 10, "a ']' is missing"},
                    Mistake{kMethod, "method: a\n", 1, 1, "no inequality"}));

TEST(Mistakes, InAMethodOfTheLibraryAreShownInItsText) {
  const MethodLibrary broken{[](const std::string&) { return "method: a\nrequire: {x: 1 +}\n"; },
                             {"a"}};
  const InputError error =
      input_error([&] { parse_problem("problem: x\nmethod: a\n", "p.yaml", broken); });
  EXPECT_EQ(error.place(), (Place{"method a", 2, 17}));
}

TEST(Method, ATaskIsOneOfThoseThatAreListed) {
  const auto method = [](const std::string& task) {
    return replaced(kMethod, "method: small\n",
                    "method: small\ntask: " + task + "\nexample: a/b\n");
  };
  EXPECT_EQ(parse_method(method("observers"), "m.yaml").task, "observers");
  EXPECT_EQ(parse_method(method("observers"), "m.yaml").example, "a/b");
  const InputError error = input_error([&] { parse_method(method("observer"), "m.yaml"); });
  EXPECT_EQ(error.place(), (Place{"m.yaml", 2, 7}));
  EXPECT_NE(error.message().find("did you mean 'observers'?"), std::string::npos) << error.what();
}

}  // namespace
}  // namespace gainsmith::io
