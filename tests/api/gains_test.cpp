#include <gtest/gtest.h>

#include <string>

#include "api/gainsmith.h"

namespace gainsmith::api {
namespace {

const std::string kPlant = R"(problem: plant
method:
  data:     {A: n x n, C: p x n, alpha: scalar}
  unknowns: {P: symmetric n, Y: n x p}
  require:
    positive: P > I
    decay:    He(P*A - Y*C) + 2*alpha*P < 0
  gains:    {L: inv(P)*Y}
data: {A: [[0, 1], [0, -1]], C: [[1, 0]], alpha: 2}
)";

TEST(Synthesize, GivesGainsWithTheirMarginsAndTheFile) {
  const Gains found = synthesize(kPlant, "plant.yaml");
  ASSERT_EQ(found.verdict, Verdict::yes);
  EXPECT_EQ(found.problem, "plant");
  const Matrix& gain = found.gains.at("L");
  ASSERT_EQ(gain.rows, 2);
  ASSERT_EQ(gain.columns, 1);
  // A - L*C has the decay rate 2: its trace is below -4, its determinant above 4.
  EXPECT_LT(-1 - gain(0, 0), -4);
  EXPECT_GT(gain(0, 0) + gain(1, 0), 4);
  ASSERT_EQ(found.margins.size(), 2U);
  EXPECT_TRUE(found.margins[1].holds);
  const Gains read = read_gains(found.text, "gains.json");
  EXPECT_EQ(read.gains.at("L").elements, gain.elements);
  EXPECT_EQ(read.text, found.text);
}

TEST(Synthesize, TakesOtherValuesOfScalars) {
  const Gains slow = synthesize(kPlant, "plant.yaml", {{"alpha", 0.1}});
  ASSERT_EQ(slow.verdict, Verdict::yes);
  EXPECT_NE(slow.gains.at("L").elements, synthesize(kPlant, "plant.yaml").gains.at("L").elements);
  EXPECT_THROW(synthesize(kPlant, "plant.yaml", {{"alhpa", 0.1}}), Error);
}

TEST(Synthesize, ShowsTheProofOfANo) {
  std::string blind = kPlant;
  blind.replace(blind.find("[[1, 0]]"), 8, "[[0, 0]]");
  EXPECT_EQ(synthesize(blind, "plant.yaml").verdict, Verdict::no);
}

TEST(Synthesize, MistakesHaveTheirPlaces) {
  std::string wrong = kPlant;
  wrong.replace(wrong.find("unknowns"), 8, "unkonwns");
  try {
    synthesize(wrong, "plant.yaml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.file, "plant.yaml");
    EXPECT_EQ(error.line, 4);
    EXPECT_EQ(error.column, 3);
    EXPECT_NE(std::string(error.what()).find("did you mean 'unknowns'?"), std::string::npos);
  }
}

TEST(ReadGains, RefusesAnEditedStatement) {
  std::string text = synthesize(kPlant, "plant.yaml").text;
  text.replace(text.find("alpha: 2"), 8, "alpha: 3");
  EXPECT_THROW(read_gains(text, "gains.json"), Error);
  EXPECT_THROW(read_gains("{", "gains.json"), Error);
}

}  // namespace
}  // namespace gainsmith::api
