// Runs whose draws are given, as JSON and back.
#include "io/json/given_run_json.h"

#include <gtest/gtest.h>

#include <string>

namespace gainsmith::io {
namespace {

model::Dynamics dynamics() {
  model::Dynamics dynamics;
  for (const char* name : {"x", "P"}) {
    model::Dynamics::Variable variable;
    variable.name = name;
    dynamics.variables.push_back(variable);
  }
  for (const char* name : {"sample", "slow"}) {
    model::Dynamics::Event event;
    event.name = name;
    dynamics.events.push_back(event);
  }
  model::Dynamics::Noise noise;
  noise.name = "w";
  dynamics.noise.push_back(noise);
  return dynamics;
}

std::string error_of(const std::string& text) {
  try {
    parse_given_run(text, "--given", dynamics());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GivenRunJson, WhatIsWrittenIsReadAgain) {
  const std::string text =
      R"({"start":{"x":[0.1,2.5],"P":[[1.5,2.5],[2.5,3.5]]},"first":{"slow":0.3},)"
      R"("lengths":{"sample":[1.1,0.5]},"lost":{"sample":[true,false]},"noise":{"w":[0.25,[1.5,2.5]]}})";
  const hybrid::GivenRun run = parse_given_run(text, "--given", dynamics());
  EXPECT_EQ(run.starts[0]->rows(), 2);
  EXPECT_EQ(run.starts[0]->cols(), 1);
  EXPECT_EQ((*run.starts[1])(1, 0), 2.5);
  EXPECT_FALSE(run.first[0]);
  EXPECT_EQ(run.first[1], 0.3);
  EXPECT_EQ(run.lengths[0], (std::vector<double>{1.1, 0.5}));
  EXPECT_EQ(run.losses[0], (std::vector<char>{1, 0}));
  EXPECT_EQ(run.noise[0][1](1), 2.5);
  EXPECT_EQ(to_json(run, dynamics()).dump(), text);
}

TEST(GivenRunJson, WhatIsNotGivenIsNotWritten) {
  EXPECT_EQ(to_json({}, dynamics()).dump(), "{}");
  EXPECT_TRUE(parse_given_run("{}", "--given", dynamics()).lengths.empty());
}

TEST(GivenRunJson, MistakesHaveTheirPlaces) {
  EXPECT_EQ(error_of(R"({"length": {}})"),
            "--given:1:2: unknown key 'length'; did you mean 'lengths'?");
  EXPECT_EQ(error_of(R"({"lengths": {"sampel": [1]}})"),
            "--given:1:14: lengths.sampel: there is no 'sampel'; did you mean 'sample'?");
  EXPECT_NE(error_of(R"({"lengths": {"sample": []}})").find("at least one element"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"lengths": {"sample": 3}})").find("expected a list"), std::string::npos);
  EXPECT_NE(error_of("[]").find("expected an object"), std::string::npos);
  EXPECT_NE(error_of("x").find("--given:1:1"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::io
