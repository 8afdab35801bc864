// Binding: what the method and the problem say is compiled, and a mistake has its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bind/small_problem.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;

struct Slip {
  std::string from;
  std::string to;
  std::string message;
};

TEST(Check, TheSmallProblemIsSound) { EXPECT_NO_THROW(Small()); }

TEST(Check, MistakesInTheMethodAreFound) {
  const std::vector<Slip> slips = {{"He(P*A) + f", "He(P*b) + f", "square"},
                                   {"+ f(tau)*Q < g*I", "+ f(tau)*Q", "expected a comparison"},
                                   {"f(tau)*Q", "f(teu)*Q", "did you mean 'tau'?"},
                                   {"[0, T2]\"", "[0, b']\"", "columns of one length"},
                                   {"minimize: g", "minimize: P", "expected 1 x 1"},
                                   {"minimize: g", "minimize: z", "unknown name 'z'"},
                                   {"K: b'*P", "K: b'*Q*q", "unknown name 'q'"},
                                   {"flow: {z: A*z}", "flow: {z: z'*A}", "expected 2 x 1"},
                                   {"jump: {z: z/2}", "jump: {z: zz/2}", "unknown name 'zz'"},
                                   {"flow: {th: K*zh}", "flow: {th: K'}", "expected 1 x 1"},
                                   {"output: {y: b'*z}", "output: {y: b*z}", "cannot multiply"},
                                   {"e: z - zh", "e: z - zh'", "cannot subtract"},
                                   {"reset: [T1, T2]", "reset: [T1, A]", "expected 1 x 1"},
                                   {"e'*P*e + s", "e*e'", "expected 1 x 1"},
                                   {"flow: y^2", "flow: e", "expected 1 x 1"},
                                   {"jump: th^2", "jump: e", "expected 1 x 1"},
                                   {"below: g", "below: P", "expected 1 x 1"},
                                   {"to: rate/100", "to: A", "expected 1 x 1"}};
  for (const Slip& slip : slips) {
    const InputError error = input_error(
        [&] { const Small small(kSmallProblem, changed(kSmallMethod, slip.from, slip.to)); });
    EXPECT_EQ(error.place().file, "method small") << slip.to << ": " << error.what();
    EXPECT_GT(error.place().line, 0) << error.what();
    EXPECT_NE(error.message().find(slip.message), std::string::npos)
        << slip.to << ": " << error.what();
  }
}

TEST(Check, MistakesInTheProblemAreFound) {
  const std::vector<Slip> slips = {
      {"horizon: 10*T2", "horizon: A", "expected 1 x 1"},
      {"first: T1", "first: T3", "did you mean 'T1'?"},
      {"{constant: T1}", "{constant: b}", "expected 1 x 1"},
      {"{list: [T1, T2]}", "{list: [T1, A]}", "expected 1 x 1"},
      {"z: [1, 2]", "z: [1, 2, 3]", "expected 2 x 1"},
      {"z: [1, 2]", "z: 1", "expected 2 x 1"},
      {"box: [-1, [1, 2]]", "box: [-1, [1, 2, 3]]", "must be a number or 2 x 1; found 1 x 3"},
      {"list: [1, b'*z]", "list: [1, b]", "expected 1 x 1"},
      {"objective:", "objectiv:", "did you mean 'objective'?"},
      {"trace(P): {value: T1", "trace(P): {value: [1, 2]", "expected 1 x 1"},
      {"K: {value: [1, 2]", "K: {value: [1, 2, 3]", "expected 1 x 2"},
      {"K: {value: [1, 2]", "K: {value: [1, z]", "unknown name 'z'"}};
  for (const Slip& slip : slips) {
    const InputError error =
        input_error([&] { const Small small(changed(kSmallProblem, slip.from, slip.to)); });
    EXPECT_EQ(error.place().file, "p.yaml") << slip.to << ": " << error.what();
    EXPECT_GT(error.place().line, 0) << error.what();
    EXPECT_NE(error.message().find(slip.message), std::string::npos)
        << slip.to << ": " << error.what();
  }
}

}  // namespace
}  // namespace gainsmith::bind
