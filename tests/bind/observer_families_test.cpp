// Observers that a method has once for all members of a family.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bind/small_problem.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;

const std::string kObserver = "observer: {state: {zh: n, th: 1}, flow: {th: K*zh}}";

/// The small problem with these observers in place of its own, and without their starts.
model::Instance with(const std::string& observers) {
  const std::string method = changed(changed(kSmallMethod, kObserver, observers + "\n"),
                                     "\n  cheap: {cost: {flow: y^2, jump: th^2}, below: g}", "");
  const std::string problem =
      changed(kSmallProblem, ", zh: {box: [-1, [1, 2]]}, th: {list: [1, b'*z]}", "");
  return Small(problem, changed(changed(method, "e: z - zh", "e: y"), "e'*P*e + s", "e")).instance;
}

std::vector<std::string> names(const model::Instance& instance) {
  std::vector<std::string> found;
  for (const auto& state : instance.design->states) found.push_back(state.name);
  return found;
}

TEST(ObserverFamilies, HaveAMemberForEachValueOfTheIndex) {
  const model::Instance found = with(
      "observers: {o: {for: i in 1..n, state: {w: {shape: 1, start: i}}, let: {f(i): 2*i, g: "
      "f(3)}, "
      "flow: {w: g + i*y}}}");
  EXPECT_EQ(names(found), (std::vector<std::string>{"z", "o_1.w", "o_2.w"}));
}

TEST(ObserverFamilies, MistakesHaveTheirPlace) {
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"observer: {for: i in 1..2, state: {w: 1}}",
       "a family of observers is an entry of 'observers'"},
      {"observers: {o: {for: [i in 1..2, k in 1..2], state: {w: 1}}, o_1: {for: k in 1..2, state: "
       "{w: 1}}}",
       "'o_1' is the name of a member of o, which is a family"},
      {"observers: {o: {for: i in 2..1, state: {w: 1}}}", "runs from 2 to 1"},
      {"observers: {o: {for: i in 1..k, state: {w: 1}}}", "there is no dimension or index 'k'"},
      {"observers: {o: {for: w in 1..2, state: {w: 1}}}",
       "'w' is an index here, but it already names"},
      {"observers: {o_1: {state: {v: 1}}, o: {for: i in 1..2, state: {w: 1}}}",
       "'o_1' is the name of a member of o, which is a family"},
      {"observers: {o: {for: i in 1..2, state: {w: 1}}, o_1: {state: {v: 1}}}",
       "'o_1' is the name of a member of o, which is a family"},
      {"observers: {o: {for: i in 1..2, state: {w: {shape: 1, start: 0}}, flow: {w: i*q}}}",
       "unknown name 'q'"}};
  for (const auto& [observers, message] : slips) {
    const InputError error = input_error([&] { with(observers); });
    EXPECT_NE(error.message().find(message), std::string::npos)
        << observers << ": " << error.what();
  }
}

}  // namespace
}  // namespace gainsmith::bind
