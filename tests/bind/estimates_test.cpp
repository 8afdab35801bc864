// Values that rest on a search over a box: labelled where they are shown, refused where something
// is to be proved.
#include <gtest/gtest.h>

#include <string>

#include "bind/small_problem.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;

const std::string kSearch = "maximum(x*delta, x in [0, 2])";

std::string refusal(const std::string& from, const std::string& to,
                    const std::string& problem = kSmallProblem) {
  return input_error([&] { Small small(problem, changed(kSmallMethod, from, to)); }).message();
}

void expect_refused(const std::string& from, const std::string& to, const std::string& what) {
  const std::string message = refusal(from, to);
  EXPECT_NE(message.find(what + " is to be proved"), std::string::npos) << message;
}

TEST(Estimates, CarryNoProof) {
  expect_refused("f(tau)*Q", kSearch + "*f(tau)*Q", "'flow'");
  expect_refused("tau in [0, T2]", "tau in [0, T2 + " + kSearch + "]", "'flow'");
  expect_refused("minimize: g", "minimize: " + kSearch + "*g", "a minimum");
  expect_refused("decay: delta > 0", "decay: '" + kSearch + " > 0'", "an assumption");
}

TEST(Estimates, CarryNoneThroughDefinitionsAndData) {
  expect_refused("exp(delta*t)}", "exp(top*t), top: \"" + kSearch + "\"}", "'flow'");
  const std::string message = refusal(
      "rate: 1", "rate: 1", changed(kSmallProblem, "T1: 0.5", "T1: \"maximum(x, x in [0, 0.5])\""));
  EXPECT_NE(message.find("'T1' rests on an estimate"), std::string::npos) << message;
}

TEST(Estimates, AreKnownByTheirNames) {
  std::string method = changed(kSmallMethod, "K: b'*P, A: A",
                               "K: b'*P, A: A, top: \"" + kSearch +
                                   "\", low: \"minimum(x^2, x in "
                                   "[1, 2])\", both: \"1/minimum(x, x in [1, 2])\"");
  method = changed(method, "signals:", "report: {again: 2*top, plain: delta}\nsignals:");
  method = changed(method, "norm(e), to: rate/100", "norm(e), to: rate/100*low");
  const Small small(kSmallProblem, method);
  using expr::Estimate;
  const std::map<std::string, Estimate> expected = {{"top", Estimate::from_below},
                                                    {"low", Estimate::from_above},
                                                    {"both", Estimate::mixed},
                                                    {"again", Estimate::mixed}};
  EXPECT_EQ(small.design().estimates, expected);
  EXPECT_EQ(small.design().claims[1].name, "cheap");
  EXPECT_EQ(small.design().claims[2].name, "small (from estimates)");
}

TEST(Estimates, AreOfConstants) {
  const std::string message =
      refusal("{e: z - zh}", "{e: z - zh, top: \"maximum(x*zh(1), x in [0, 1])\"}");
  EXPECT_NE(message.find("'observer.zh' changes along a run"), std::string::npos) << message;
}

}  // namespace
}  // namespace gainsmith::bind
