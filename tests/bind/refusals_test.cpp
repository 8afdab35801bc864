// Data, parameters and assumptions that do not fit: the place and what is said.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bind/small_problem.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;

struct Refusal {
  std::string from;
  std::string to;
  Place place;
  std::string message;
};

void expect_refused(const Refusal& refusal, const std::string& method = kSmallMethod) {
  const std::string text = changed(kSmallProblem, refusal.from, refusal.to);
  const InputError error = input_error([&] { Small small(text, method); });
  EXPECT_EQ(error.place(), refusal.place) << refusal.to << ": " << error.what();
  EXPECT_NE(error.message().find(refusal.message), std::string::npos) << error.what();
}

Place at(int line, int column) { return {"p.yaml", line, column}; }

TEST(Refusal, MissingAndMisspeltData) {
  expect_refused(
      {"  b: [5, 6]\n", "", {"p.yaml"}, "the datum b (n) of the method small is missing"});
  expect_refused({"  T1:", "  T1_:", at(6, 3), "has no datum 'T1_'; did you mean 'T1'?"});
  expect_refused({"  T1:", "  delta: 1\n  T1:", at(6, 3), "write it under 'parameters'"});
}

TEST(Refusal, MissingAndMisspeltParameters) {
  expect_refused({"campaign", "parameters: {dleta: 1}\ncampaign", at(7, 14),
                  "has no parameter 'dleta'; did you mean 'delta'?"});
  expect_refused({"campaign", "parameters: {T2: 1}\ncampaign", at(7, 14), "write it under 'data'"});
  expect_refused({"problem: p", "problem: p", {"p.yaml"}, "the parameter rate"},
                 changed(kSmallMethod, "rate: 1", "rate:"));
  expect_refused({"campaign", "parameters: {rate: [1, 2]}\ncampaign", at(7, 20), "expected 1 x 1"});
}

TEST(Refusal, AnUnknownThatNothingDetermines) {
  const auto refusal = [](const std::string& unknowns, const std::string& gains) {
    std::string method =
        changed(kSmallMethod, "unknowns: {P: symmetric n, X: n x m, g: scalar}", unknowns);
    method = changed(method, "K: b'*P, A: A", gains);
    const Small small(kSmallProblem, method);
    return input_error([&] { refuse_free_unknowns(*small.instance.design); });
  };
  const InputError unused =
      refusal("unknowns: {P: symmetric n, X: n x m, g: scalar}", "K: b'*P, A: A");
  EXPECT_EQ(unused.place().line, 13) << unused.what();
  EXPECT_NE(unused.message().find("unknown X is used by no inequality"), std::string::npos);
  const InputError gain =
      refusal("unknowns: {P: symmetric n, X: n x m, g: scalar}", "K: b'*P, A: A, F: X");
  EXPECT_NE(gain.message().find("the gain F needs it"), std::string::npos) << gain.what();
  const InputError function =
      refusal("unknowns: {P: symmetric n, X: {shape: n x m, of: t, degree: 1}, g: scalar}",
              "K: b'*P, A: A");
  EXPECT_NE(function.message().find("unknown X"), std::string::npos) << function.what();
}

TEST(Refusal, OverridesOfWhatIsNoScalar) {
  const Small small;
  const auto message = [&](const model::Overrides& overrides) {
    return input_error([&] { bind(small.problem, overrides); }).message();
  };
  EXPECT_NE(message({{"T11", 1}}).find("did you mean 'T1'?"), std::string::npos);
  EXPECT_NE(message({{"A", 1}}).find("'A' is a matrix (n x n)"), std::string::npos);
  EXPECT_NE(message({{"P", 1}}).find("no scalar datum or parameter 'P'"), std::string::npos);
  EXPECT_NE(message({{"T1", std::nan("")}}).find("finite"), std::string::npos);
  EXPECT_NE(message({{"delta", INFINITY}}).find("finite"), std::string::npos);
  EXPECT_NE(message({{"T1", 3}, {"T2", 2}}).find("expected 0 < T1 <= T2"), std::string::npos);
}

TEST(Refusal, WrongShapes) {
  expect_refused({"[[1, 2], [3, 4]]", "[[1, 2, 3], [4, 5, 6]]", at(4, 3),
                  "A is declared n x n (n = 2); found 2 x 3"});
  expect_refused({"[5, 6]", "[5, 6, 7]", at(5, 3), "b is declared n (n = 2); found 3 x 1"});
  expect_refused({"T1: 0.5", "T1: [1, 2]", at(6, 3), "T1 is declared scalar; found 1 x 2"});
  expect_refused(
      {"  T1:", "  Q: 5\n  T1:", at(6, 6),
       "5 (1 x 1) has the wrong shape: expected 2 x 2; a multiple of the identity is written 5*I"});
  expect_refused({"  T1:", "  Q: [[1, 2]]\n  T1:", at(6, 3), "symmetric n (n = 2); found 1 x 2"});
}

TEST(Refusal, SizesThatFollowFromLaterDataAreCheckedToo) {
  expect_refused({"  T1:", "  extra: [[1], [2]]\n  T1:", at(6, 3),
                  "extra is declared n + m x 1 (m = 1, n = 2); found 2 x 1"});
}

TEST(Refusal, EmptyData) {
  const std::string method =
      changed(kSmallMethod, "  b: n\n", "  b: {shape: n, default: \"zeros(n, 1)\"}\n");
  const std::string text =
      changed(changed(kSmallProblem, "[[1, 2], [3, 4]]", "zeros(0)"), "  b: [5, 6]\n", "");
  const InputError error = input_error([&] { Small small(text, method); });
  EXPECT_NE(error.message().find("found 0 x 0"), std::string::npos) << error.what();
}

TEST(Refusal, NotOfADatumWithoutRowsOrColumns) {
  const std::string method = changed(kSmallMethod, "  b: n\n", "  b: n\n  H: k x n\n  G: n x m2\n");
  const std::string data = "  H: \"zeros(0, n)\"\n  G: \"zeros(n, 0)\"\n  T1:";
  const Small small(changed(kSmallProblem, "  T1:", data), method);
  EXPECT_EQ(small.instance.values.at("H").rows(), 0);
  EXPECT_EQ(small.instance.values.at("H").cols(), 2);
  EXPECT_EQ(small.instance.values.at("G").cols(), 0);
}

TEST(Refusal, AMatrixThatIsNotSymmetricIsShownAtTheElement) {
  expect_refused({"  T1:", "  Q: [[1, 2], [2.5, 1]]\n  T1:", at(6, 16),
                  "Q must be symmetric, but element (2, 1) is 2.5 and element (1, 2) is 2"});
  expect_refused({"  T1:", "  Q: \"[1, 2; 2.5, 1]\"\n  T1:", at(6, 14), "element (2, 1)"});
  expect_refused({"  T1:", "  Q: \"[1, 2;\n   2.5, 1]\"\n  T1:", at(7, 4), "element (2, 1)"});
  expect_refused({"  T1:", "  Q: A\n  T1:", at(6, 3), "element (2, 1) is 3"});
}

TEST(Refusal, AnElementInsideAPartOfABlockIsShownAtTheDatum) {
  const std::string four = "[[1, 2, 0, 0], [3, 4, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
  const std::string text = changed(kSmallProblem, "[[1, 2], [3, 4]]", four);
  const std::string blocks =
      changed(changed(text, "[5, 6]", "[5, 6, 7, 8]"),
              "  T1:", "  Q: \"[A(1:2, 1:2), zeros(2); zeros(2), eye(2)]\"\n  T1:");
  const InputError error = input_error([&] { Small small(blocks); });
  EXPECT_EQ(error.place(), at(6, 3)) << error.what();
  EXPECT_NE(error.message().find("element (2, 1) is 3"), std::string::npos) << error.what();
}

TEST(Refusal, AMatrixThatIsNotDiagonal) {
  expect_refused({"  T1:", "  D: [[1, 0], [7, 1]]\n  T1:", at(6, 16),
                  "D must be diagonal, but element (2, 1) is 7"});
}

TEST(Refusal, AnAssumptionThatFailsIsShownAtTheDatum) {
  expect_refused(
      {"T1: 0.5", "T1: 0.5\n  T2: 0.25", at(7, 3), "T1 = 0.5, T2 = 0.25: expected 0 < T1 <= T2"});
  expect_refused({"T1: 0.5", "T1: 0", at(6, 3), "expected 0 < T1 <= T2"});
  expect_refused({"campaign", "parameters: {delta: -1}\ncampaign", at(7, 14),
                  "delta = -1: expected delta > 0"});
}

TEST(Refusal, AnAssumptionWithoutNamesSaysWhatIsExpected) {
  const std::string method = changed(kSmallMethod, "decay: delta > 0", "decay: 2 < 1");
  const InputError error = input_error([&] { Small small(kSmallProblem, method); });
  EXPECT_EQ(error.message(), "expected 2 < 1, the assumption 'decay'");
}

TEST(Refusal, MistakesInDataAreShownInTheProblem) {
  expect_refused({"T1: 0.5", "T1: 1/0", at(6, 7), "division by zero"});
  expect_refused(
      {"T1: 0.5", "T1: T2", at(6, 7), "unknown name 'T2' here: the method declares it after T1"});
  expect_refused({"T1: 0.5", "T1: 1e999", at(6, 7), "beyond the range"});
}

TEST(Refusal, SizesThatDoNotFollowFromTheData) {
  const std::string method = changed(kSmallMethod, "X: n x m", "X: n x q");
  const InputError error = input_error([&] { Small small(kSmallProblem, method); });
  EXPECT_NE(error.message().find("size of the unknown X (n x q) does not follow"),
            std::string::npos)
      << error.what();
  EXPECT_EQ(error.place(), (Place{"method small", 13, 28}));
}

}  // namespace
}  // namespace gainsmith::bind
