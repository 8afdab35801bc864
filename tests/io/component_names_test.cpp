// Names of plant and observers that the method has too.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "expr/text/text.h"
#include "io/problem_text.h"
#include "model/dynamics_programs.h"

namespace gainsmith::io {
namespace {

using model::Dynamics;
using tests::input_error;

/// Datum A and state A, definition y and output y, observer state T.
const std::string kShared = R"(problem: shared
method:
  method: shared
  data: {A: {shape: scalar, default: 3}}
  let: {y: 10*A, twice(v): 2*A*v}
  plant:
    state: {A: {shape: scalar, start: 1}}
    output: {y: twice(A)}
    flow: {A: -A}
  observer:
    state: {T: {shape: scalar, start: 0}}
    flow: {T: A*(y - T)}
  signals: {of_plant: plant.A, of_data: A, outside: y, e: plant.y - T, f: observer.T}
  claims: {small: {shrinks: plant.A, to: 0.5}}
campaign: {horizon: 1, initial: {A: 7}}
)";

std::vector<std::string> inputs_of(const expr::Program& program) {
  std::vector<std::string> names;
  for (const expr::Input& input : program.inputs) names.push_back(input.name);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> inputs_of(const model::DesignPtr& design, const std::string& signal) {
  for (const Dynamics::Signal& one : design->dynamics->signals)
    if (one.name == signal) return inputs_of(one.value.program);
  ADD_FAILURE() << "no signal " << signal;
  return {};
}

using Names = std::vector<std::string>;

TEST(ComponentNames, ThoseOfThePlantHideThoseOfTheMethodWithinIt) {
  const model::DesignPtr design = bound(kShared);
  const Dynamics& dynamics = *design->dynamics;
  EXPECT_EQ(dynamics.variables.at(0).name, "plant.A");
  EXPECT_EQ(inputs_of(dynamics.flow.at(0).value.program), Names{"plant.A"});
  EXPECT_EQ(inputs_of(design, "plant.y"), (Names{"A", "plant.A"}));
  EXPECT_EQ(design->campaign.starts.at(0).state, 0U);
}

/// Of the plant it reads outputs: y is that of the plant, A the datum.
TEST(ComponentNames, AnObserverReadsOutputsBeforeDefinitions) {
  const model::DesignPtr design = bound(kShared);
  EXPECT_EQ(inputs_of(design->dynamics->flow.at(1).value.program),
            (Names{"A", "observer.T", "plant.A"}));
}

TEST(ComponentNames, OutsideTheyAreThoseOfTheMethod) {
  const model::DesignPtr design = bound(kShared);
  EXPECT_EQ(inputs_of(design, "of_plant"), Names{"plant.A"});
  EXPECT_EQ(inputs_of(design, "of_data"), Names{"A"});
  EXPECT_EQ(inputs_of(design, "outside"), Names{"A"});
}

/// "observer.T" is a state and no transpose.
TEST(ComponentNames, AStateTIsReadFromOutside) {
  EXPECT_EQ(inputs_of(bound(kShared), "f"), Names{"observer.T"});
  const auto error = input_error([&] { bound(replaced(kShared, "f: observer.T", "f: A.T")); });
  EXPECT_NE(error.message().find("write ' for the transpose"), std::string::npos);
}

TEST(ComponentNames, SignalsInputsAndNoiseKeepNamesOfTheirOwn) {
  const auto error =
      input_error([&] { bound(replaced(kShared, "signals: {", "signals: {A: 1, ")); });
  EXPECT_NE(error.message().find("already names"), std::string::npos);
  input_error([&] { bound(replaced(kShared, "  plant:\n", "  inputs: {A: t}\n  plant:\n")); });
  input_error([&] { bound(replaced(kShared, "let: {y: 10*A", "let: {A: 2, y: 10*A")); });
}

TEST(ComponentNames, TwoOfThePlantDiffer) {
  input_error([&] { bound(replaced(kShared, "output: {y: twice(A)}", "output: {A: twice(A)}")); });
}

}  // namespace
}  // namespace gainsmith::io
