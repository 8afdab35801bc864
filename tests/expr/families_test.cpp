// Names with indices, sums over them, and texts about any member made those about one.
#include <gtest/gtest.h>

#include "expr/binding/instantiate.h"
#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Families : public testing::Test {
 protected:
  Families() {
    std::mt19937 random(5);
    for (const char* name : {"A_1", "A_2", "A_3"}) world.set(name, eighths(random, 2, 2));
    for (const char* name : {"B_0_4", "B_0_5", "B_1_4", "B_1_5"})
      world.set(name, eighths(random, 2, 3));
    world.scope.families = {{"A", {{1, 3}}}, {"B", {{0, 1}, {4, 5}}}};
    world.scope.dimensions = {{"N", 3}};
  }
  /// Random, and with products that double holds exactly.
  static Matrix eighths(std::mt19937& random, int rows, int columns) {
    return (8 * random_matrix(random, rows, columns)).array().round() / 8;
  }
  Matrix A(int i) const { return world.values.at("A_" + std::to_string(i)); }
  std::string message(const std::string& text) const {
    return input_error([&] { world(text); }).message();
  }

  World world;
};

TEST_F(Families, AMemberIsChosenByWholeNumbers) {
  EXPECT_EQ(world("A(2)"), A(2));
  EXPECT_EQ(world("A(N - 1)*A(1)"), A(2) * A(1));
  EXPECT_EQ(world("B(1, 4)"), world.values.at("B_1_4"));
  EXPECT_EQ(world("A(3)(1, 2)")(0, 0), A(3)(0, 1));
  EXPECT_EQ(world("A(3)'"), A(3).transpose());
}

TEST_F(Families, AModeChoosesAMember) {
  world.scope.symbols["q"] = {{}, false, true, true};
  world.define("V(i)", "A(i)*A(1)");
  for (int q = 1; q <= 3; ++q) {
    world.values["q"] = Matrix::Constant(1, 1, q);
    EXPECT_EQ(world("A(q)"), A(q));
    EXPECT_EQ(world("A(4 - q)"), A(4 - q));
    EXPECT_EQ(world("V(q)"), A(q) * A(1));
    EXPECT_EQ(world("A(q)(1, 2)")(0, 0), A(q)(0, 1));
  }
  world.values["q"] = Matrix::Constant(1, 1, 0);
  EXPECT_EQ(world("B(q, 5)"), world.values.at("B_0_5"));
  EXPECT_EQ(world("B(q, q + 4)"), world.values.at("B_0_4"));
  for (const double outside : {0.0, 4.0, -7.0}) {
    world.values["q"] = Matrix::Constant(1, 1, outside);
    EXPECT_NE(message("A(q)").find("has the members 1 to 3, and 'q' is none of them"),
              std::string::npos)
        << message("A(q)");
  }
  world.set("s", 2);
  EXPECT_NE(message("A(s)").find("whole number known beforehand"), std::string::npos);
}

TEST_F(Families, EndIsTheLastMember) {
  EXPECT_EQ(world("A(end)"), A(3));
  EXPECT_EQ(world("B(1, end - 1)"), world.values.at("B_1_4"));
}

TEST_F(Families, DefinitionsTakeIndices) {
  world.define("V(i)", "A(i)*A(i + 1)").define("W(k, i)", "k*V(i - 1)");
  EXPECT_EQ(world("V(2)"), A(2) * A(3));
  EXPECT_EQ(world("W(2, 2)"), 2 * (A(1) * A(2)));
  EXPECT_NE(message("V(3)").find("has the members 1 to 3; found 4"), std::string::npos);
}

TEST_F(Families, SumsRunOverTheirIndices) {
  EXPECT_EQ(world("sum(i in 1..N, i*A(i))"), A(1) + 2 * A(2) + 3 * A(3));
  EXPECT_EQ(world("sum(i in 1..N, j in 1..N, i != j, A(i)*A(j))"),
            A(1) * A(2) + A(1) * A(3) + A(2) * A(1) + A(2) * A(3) + A(3) * A(1) + A(3) * A(2));
  EXPECT_EQ(world("sum(i in 1..N, j in i + 1..N, A(i)*A(j))"),
            world("sum(i in 1..N, sum(j in 1..N, i < j <= N, A(i)*A(j)))"));
  EXPECT_EQ(world("A(1) + sum(i in 2..1, A(i))"), A(1));
  EXPECT_EQ(world("sum(i in 1..2, I) + A(1)"), A(1) + 2 * Matrix::Identity(2, 2));
}

TEST_F(Families, ConcatenationsRunOverTheirIndices) {
  EXPECT_EQ(world("horzcat(i in 1..N, i*A(i))"), world("[A(1), 2*A(2), 3*A(3)]"));
  EXPECT_EQ(world("vertcat(i in 1..N, i != 2, A(i))"), world("[A(1); A(3)]"));
  EXPECT_EQ(world("blkdiag(i in 1..2, A(i))"), world("blkdiag(A(1), A(2))"));
  EXPECT_EQ(world("horzcat(A(1), [1; 2])"), world("[A(1), [1; 2]]"));
  EXPECT_EQ(world("vertcat(i in 2..2, A(i))"), A(2));
  EXPECT_EQ(world("horzcat(i in 1..3, vertcat(j in 1..2, i*j))"), world("[1, 2, 3; 2, 4, 6]"));
}

TEST_F(Families, ASumOfOneArgumentIsThatOfItsElements) {
  EXPECT_NEAR(world("sum(A(1))")(0, 0), A(1).sum(), 1e-15);
  EXPECT_EQ(world("sum([1, 2, 3])")(0, 0), 6);
  EXPECT_EQ(world("sum([1; 2; 3])")(0, 0), 6);
  EXPECT_EQ(world("sum(7)")(0, 0), 7);
}

TEST_F(Families, TheKroneckerProductHasItsRules) {
  std::mt19937 random(6);
  world.set("P", random_matrix(random, 2, 3)).set("Q", random_matrix(random, 3, 1));
  world.set("R", random_matrix(random, 3, 2)).set("S", random_matrix(random, 1, 4));
  EXPECT_LE(relative_difference(world("kron(P, Q)*kron(R, S)"), world("kron(P*R, Q*S)")), 1e-14);
  EXPECT_EQ(world("kron(P, Q)'"), world("kron(P', Q')"));
  EXPECT_EQ(world("sum(kron(zeros(0, 2), P))")(0, 0), 0);
  EXPECT_EQ(world("kron(2, P)"), world("2*P"));
  EXPECT_EQ(world("kron(P, 2)"), world("2*P"));
  EXPECT_EQ(world("kron(eye(2), P)"), world("blkdiag(P, P)"));
}

TEST_F(Families, MistakesAreNamed) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"A", "'A' is a family: write one of its members"},
      {"A(0)", "has the members 1 to 3; found 0"},
      {"A(1.5)", "must be a whole number known beforehand, not '1.5'"},
      {"A(1, 2)", "takes 1 indices, not 2"},
      {"A(j)", "there is no dimension or index 'j' here"},
      {"sum(i in 1..N)", "an index is allowed only first in sum, horzcat, vertcat and blkdiag"},
      {"sum(i in 1..x, A(i))", "the end of a range must be a whole number"},
      {"sum(1, A(1))", "a sum is written sum(i in 1..N, P(i))"},
      {"sum(i in 1..N, i, A(i))", "expected a comparison of indices such as i != j"},
      {"sum(N in 1..2, A(1))", "'N' already has a meaning here"},
      {"sum(i in 1..2, sum(i in 1..2, A(i)))", "'i' already has a meaning here"},
      {"exp(i in 1..2)", "an index is allowed only first in sum"},
      {"horzcat(A(1), i in 1..2, A(i))", "an index is allowed only first in sum"},
      {"horzcat(i in 1..N)", "an index is allowed only first in sum"},
      {"horzcat(i in 2..1, A(i))", "horzcat: the indices have no values"},
      {"horzcat(A(1), 1)", "all parts need as many rows; one is 2 x 2 and another 1 x 1"},
      {"vertcat(i in 1..2, ones(1, i))", "all parts need as many columns"},
      {"kron(I, A(1))", "write eye(n)"},
      {"sum(i in 1..1000000000, A(1))", "an index has at most 100000"},
      {"sum(i in 1..2000000000, A(1))", "the end of a range is at most 1000000000"},
      {"sum(i in 1..1000, sum(j in 1..1000, A(1)))", "expand to too many operations"},
      {"where(x != 1, A(1), A(2))", "unknown name 'x'"}};
  for (const auto& [text, expected] : cases) {
    const std::string found = input_error([&] { world(text); }).message();
    EXPECT_NE(found.find(expected), std::string::npos) << text << ": " << found;
  }
}

TEST_F(Families, ATextAboutAnyMemberBecomesOneAboutOne) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"inv(A(i))*Y(i)", "inv(A_2)*Y(2)"},
      {"A(i + 1)'*(A(N) - i*I)", "A_3'*(A(N) - 2*I)"},
      {"derivative(A(i))(s) + A(i)(i, 1)", "derivative(A_2)(s) + A_2(2, 1)"},
      {"B(i - 2, 4) < A(7)", "B_0_4 < A(7)"},
      {"sum(j in 1..i, A(j))", "sum(j in 1..2, A(j))"},
      {"x", "x"}};
  for (const auto& [text, expected] : cases) {
    const Expression one = instantiate(parse({text, "f"}), {{"i", 2}}, world.scope.families);
    EXPECT_EQ(one.text->str(), expected);
    // The tree is that of the text.
    EXPECT_EQ(one.quote(*one.root), expected);
    const Expression again = parse({expected, "f"});
    EXPECT_EQ(one.root->kind, again.root->kind) << text;
    EXPECT_EQ(names_in(one), names_in(again)) << text;
  }
  const Expression one =
      instantiate(parse({"A(i) + unknown", "f"}), {{"i", 2}}, world.scope.families);
  EXPECT_EQ(input_error([&] { compile(one, world.scope); }).place(), (Place{"f", 1, 8}));
  EXPECT_NE(input_error([&] {
              instantiate(parse({"sum(i in 1..2, i)", "f"}), {{"i", 2}}, {});
            })
                .message()
                .find("'i' already is an index here"),
            std::string::npos);
}

TEST(IndexText, IsANameAndARange) {
  const Index index = parse_index({" i in 1 .. n + 1", "f"});
  EXPECT_EQ(index.name, "i");
  EXPECT_EQ(index.high.quote(*index.high.root), "n + 1");
  const Signature gain = parse_signature({"L(i in 1..N, j in 0..2)(s)", "f"});
  EXPECT_EQ(gain.name, "L");
  ASSERT_EQ(gain.indices.size(), 2U);
  EXPECT_EQ(gain.indices[1].name, "j");
  EXPECT_EQ(gain.parameters, std::vector<std::string>{"s"});
  const std::vector<std::pair<std::string, int>> cases = {
      {"i", 1}, {"i in", 5}, {"i in 1", 7}, {"i in 1.2", 9}, {"i in 1..", 9}, {"i in 1..N x", 11}};
  for (const auto& [text, column] : cases) {
    const InputError error = input_error([&] { parse_index({text, "f"}); });
    EXPECT_EQ(error.place(), (Place{"f", 1, column})) << text << ": " << error.what();
  }
}

}  // namespace
}  // namespace gainsmith::expr
