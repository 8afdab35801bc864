// Observers of nonlinear plants as a person meets them: what is said where there is none.
#include <gtest/gtest.h>

#include <string>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

std::string observer(const std::string& low, const std::string& high, const std::string& f,
                     const std::string& h, const std::string& more = "") {
  return "problem: plant\nmethod: nonlinear-observer\ndata:\n  low: " + low + "\n  high: " + high +
         "\n  f(x): \"" + f + "\"\n  h(x): \"" + h + "\"\n" + more;
}

Outcome synth(const std::string& text) {
  const Folder folder;
  return gainsmith({"synth", folder.file("plant.yaml", text)});
}

/// With the line breaks of the summary taken out.
bool says(const std::string& text, const std::string& words) {
  std::string flat;
  for (const char c : text)
    if (c != '\n' && !(c == ' ' && flat.ends_with(' ')))
      flat += c;
    else if (!flat.ends_with(' '))
      flat += ' ';
  return flat.find(words) != std::string::npos;
}

TEST(NonlinearObserver, AModeThatTheOutputDoesNotShowIsNamedWithItsPoint) {
  const Outcome at_rest = synth(observer("[-1, -1]", "[1, 1]", "[x(2); 4*x(1)]", "x(1)^2"));
  EXPECT_NE(at_rest.exit, 0);
  EXPECT_TRUE(says(at_rest.out,
                   "linearised at x_1 = 0, x_2 = 0: eigenvalue 2 in the direction "
                   "[0.5; 1]"))
      << at_rest.out;
  const Outcome anywhere =
      synth(observer("[-1, -1]", "[1, 1]", "[0.5*x(1); sin(x(1)) - x(2)]", "x(1)*0 + x(2)*0"));
  EXPECT_TRUE(says(anywhere.out, "eigenvalue 0.5 in the direction")) << anywhere.out;
  const Outcome seen = synth(observer("[-1, -1]", "[1, 1]", "[x(2); 4*x(1)]", "x(1)"));
  EXPECT_EQ(seen.exit, 0) << seen.out;
  EXPECT_FALSE(says(seen.out, "Hautus")) << seen.out;
}

TEST(NonlinearObserver, APoleInTheBoxIsNamedWithPlaceAndPoint) {
  struct Case {
    const char *low, *high, *f, *column, *message, *point;
  };
  for (const Case& one :
       {Case{"[-1, -1]", "[1, 1]", "[x(2); 1/x(1) - x(2)]", ":6:17", "division by zero",
             "x_1 = 0, "},
        Case{"[-1, -1]", "[1, 1]", "[x(2); x(1)/(0.25 - x(2))]", ":6:17", "division by zero",
             "x_2 = 0.25"},
        Case{"[-0.5, 0.2]", "[2, 2]", "[0.5 - sqrt(x(1)); sqrt(x(1)) - sqrt(x(2))]", ":6:17",
             "sqrt of -0.75", "x_1 = -0.75"},
        Case{"[-1, -1]", "[1, 1]", "[inv(x(1) + 0.3)*x(2); -x(2)]", ":6:11", "singular",
             "x_1 = -0.3"}}) {
    const Outcome outcome = synth(observer(one.low, one.high, one.f, "x(1)"));
    EXPECT_NE(outcome.exit, 0) << one.f;
    EXPECT_NE(outcome.exit, 70) << one.f;
    for (const char* words : {one.column, one.message, one.point})
      EXPECT_TRUE(says(outcome.out + outcome.err, words)) << words << "\n"
                                                          << outcome.out << outcome.err;
  }
}

TEST(NonlinearObserver, ARunThatLeavesTheBoxIsOpenForThatReasonAlone) {
  const Folder folder;
  const std::string gains = folder.path("gains.json");
  const std::string text =
      observer("[-1, -1]", "[1, 1]", "[x(2); 0.5*sin(x(1)) + 1]", "x(1)",
               "campaign: {runs: 5, horizon: 5, initial: {x: 0, xh: {box: [-1, 1]}}}\n");
  ASSERT_EQ(gainsmith({"synth", folder.file("plant.yaml", text), "-o", gains}).exit, 0);
  const Outcome outcome = gainsmith({"verify", gains});
  EXPECT_EQ(outcome.exit, 3) << outcome.out;
  const std::string words = ", before the claim could be decided";
  EXPECT_TRUE(says(outcome.out, " ended at (t, j) = (")) << outcome.out;
  EXPECT_TRUE(says(outcome.out, words)) << outcome.out;
  EXPECT_FALSE(says(outcome.out, "against")) << outcome.out;
  const Outcome run = gainsmith({"simulate", gains, "-o", folder.path("run.csv")});
  EXPECT_TRUE(says(run.out, "undecided: the run ended at (t, j) = (")) << run.out;
  EXPECT_TRUE(says(run.out, words)) << run.out;
  EXPECT_FALSE(says(outcome.out, "nothing is certain")) << outcome.out;
}

TEST(NonlinearObserver, OtherObserversRunBesideIt) {
  const Folder folder;
  const std::string file = folder.file("p.yaml", R"yaml(problem: pendulum
method:
  like: nonlinear-observer
  observers:
    slow: {like: observer, let: {L: "[1; 1]"}}
    ekf:
      state: {xh: {shape: 2, start: 0}, S: {shape: symmetric 2, start: I}}
      let:   {C: "jacobian(h(xh), xh)", K: S*C'/0.01}
      flow:  {xh: "f(xh) + K*(y - h(xh))", S: "He(jacobian(f(xh), xh)*S) + 0.1*I - K*C*S"}
data:
  f(x): "[x(2); -9.81*sin(x(1)) - 0.5*x(2)]"
  h(x): x(1)
  low:  [-1, -3]
  high: [1, 3]
parameters: {alpha: 1}
compare: [{peak: norm(x - xh)}]
campaign: {runs: 4, horizon: 3, initial: {x: [0.5, 0]}}
)yaml");
  const std::string gains = folder.path("g.json");
  const Outcome synth = gainsmith({"synth", file, "-o", gains});
  ASSERT_EQ(synth.exit, 0) << synth.out << synth.err;
  const Outcome outcome = gainsmith({"simulate", gains, "--compare"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  for (const char* name : {"observer", "slow", "ekf"})
    EXPECT_TRUE(has(outcome.out, name)) << outcome.out;
}

/// The jacobian of x |x| has a kink at 0, where no second derivative is known.
TEST(NonlinearObserver, ADampingByTheSquareOfTheRateIsShown) {
  const Folder folder;
  const Outcome outcome = gainsmith({"synth", folder.file("p.yaml", R"yaml(problem: ship
method: nonlinear-observer
data:
  f(x): "[x(2); -0.2*x(2) - 0.4*x(2)*abs(x(2)) - x(1) + 0.6*x(1)^3 + x(3); -0.05*x(3)]"
  h(x): x(1)
  low:  [-1, -0.8, -0.25]
  high: [1, 0.8, 0.25]
parameters: {alpha: 0.5, gain: 20}
no campaign: gains alone
)yaml")});
  EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "checked between them")) << outcome.out;
}

/// P is the Lyapunov matrix of the method: its claim would be about the other observer alone.
/// Beside an angle, whose sine and cosine turn the equations; `where` may jump for all that is known.
TEST(NonlinearObserver, FrictionAndSaturationAreShownAndAJumpIsNot) {
  const auto drone = [](const std::string& drag) {
    return synth(observer("[-5, -5, -0.5, -3, -3, -1]", "[5, 5, 0.5, 3, 3, 1]",
                          "[x(4:6); -10*sin(x(3)) - " + drag + "; 10*cos(x(3)) - 9.81; -2*x(6)]",
                          "x(1:3)"));
  };
  for (const std::string drag : {"0.1*abs(x(4))*x(4)", "0.5*clip(x(4), -1, 1)",
                                 "max(0.1*x(4), 0.3*x(4) - 0.2)", "0.2*abs(x(4))"}) {
    const Outcome shown = drone(drag);
    EXPECT_EQ(shown.exit, 0) << drag << "\n" << shown.out << shown.err;
  }
  // Beside a point of a table there are the slopes of its two pieces, and no others.
  const Outcome table = synth(
      observer("[-1, -1]", "[1, 1]", "[x(2); -x(1)]", "interp1([-2, 0, 2], [-2, 0, 4], x(1))"));
  EXPECT_EQ(table.exit, 0) << table.out << table.err;
  EXPECT_TRUE(says(synth(observer("[-1, -1]", "[1, 1]", "[x(2); -sign(x(2)) - x(1)]", "x(1)")).out,
                   "verdict undecided"));
}

TEST(NonlinearObserver, ANameOfTheMethodIsNotTakenByAnotherObserver) {
  const Folder folder;
  const Outcome outcome = gainsmith({"check", folder.file("p.yaml", R"yaml(problem: p
method:
  like: nonlinear-observer
  observers:
    ekf:
      state: {xh: {shape: 2, start: 0}, P: {shape: symmetric 2, start: I}}
      flow:  {xh: f(xh), P: He(P)}
data: {f(x): "[x(2); -sin(x(1)) - x(2)]", h(x): x(1), low: [-1, -1], high: [1, 1]}
campaign: {runs: 4, horizon: 3, initial: {x: [0.5, 0]}}
)yaml")});
  EXPECT_EQ(outcome.exit, 2) << outcome.out;
  EXPECT_TRUE(has(outcome.err, "'P' is a name of the observer 'ekf' and of the method"))
      << outcome.err;
}

/// -0.1*3 + 0.3 is not 0 in double.
TEST(NonlinearStateFeedback, ARestPointMayBeRounded) {
  const Folder folder;
  const std::string text = R"yaml(problem: p
method: nonlinear-state-feedback
data: {low: [-0.3], high: [0.3], start: [0.1], limit: [5], "f(x, u)": -0.1*(x + 3) + 0.3 + u}
no campaign: gains alone
)yaml";
  EXPECT_EQ(gainsmith({"synth", folder.file("p.yaml", text)}).exit, 0);
  const Outcome moved =
      gainsmith({"synth", folder.file("q.yaml", with(text, "0.3 + u", "0.31 + u"))});
  EXPECT_EQ(moved.exit, 2) << moved.out;
  EXPECT_TRUE(has(moved.err, "the assumption 'rest'")) << moved.err;
}

}  // namespace
}  // namespace gainsmith::tests
