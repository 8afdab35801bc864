// Published examples, against numbers that were computed independently
// (linear-hybrid observers, constrained and uniting observers).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "judge/judge.h"
#include "support/event_problem.h"
#include "support/reference_run.h"

namespace gainsmith::simulate {
namespace {

using numbers::Matrix;
using tests::EventProblem;
using tests::jumps_of;
using tests::part_of;

/// A run, which the judge accepts.
hybrid::Trajectory judged_run(const hybrid::System& system, double horizon,
                              const Accuracy& accuracy = {}) {
  const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system);
  const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0, accuracy);
  judge::Question question;
  question.relative = accuracy.relative;
  question.absolute = accuracy.absolute;
  model::Dynamics written = system.dynamics;
  for (std::size_t k = 0; k < written.flow.size(); ++k)
    if (system.free_flow[k]) written.flow[k].value.program = *system.free_flow[k];
  const model::Stated stated{system.constants, {}, {}};
  const auto faults = judge::check_trajectory(run, written, stated, question);
  EXPECT_TRUE(faults.empty()) << tests::to_text(faults);
  return run;
}

/// The largest |element| over the flows up to a time.
double peak(const hybrid::System& system, const hybrid::Trajectory& run, const std::string& name,
            Eigen::Index element, double until = 1e9) {
  double largest = 0;
  for (const auto& part : run.parts)
    if (const auto* piece = std::get_if<hybrid::FlowPiece>(&part))
      for (const hybrid::DenseStep& step : piece->steps)
        for (int k = 0; k <= 32 && step.from < until; ++k) {
          const double t = step.from + (step.to - step.from) * k / 32;
          largest = std::max(largest, std::abs(part_of(system, step(t), name)(element)));
        }
  return largest;
}

TEST(EventExamples, SpikingNeuron) {
  EventProblem problem;
  problem.state("x", {4, 1}, "[-55; -6; -55; 4]");
  problem.flow("x", "[0.04*x(1)^2 + 5*x(1) + 140 - x(2) + 10; 0.02*(0.2*x(1) - x(2)); 0; 0]");
  problem.when("spike", "x(1) >= 30").jump("spike", {{"x", "[x(3); x(2) + x(4); x(3); x(4)]"}});
  const hybrid::Trajectory run = judged_run(problem.system(), 110);
  const auto spikes = jumps_of(run);
  const std::vector<double> expected = {3.153121138, 39.249265026, 70.456712589, 101.674996734};
  ASSERT_EQ(spikes.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(spikes[k].t, expected[k], 1e-6) << k;
}

TEST(EventExamples, BallWithUnknownRestitution) {
  EventProblem problem;
  problem.data("l", 10).data("g", 9.8).data("ud", 5).data("Kd", Matrix{{0, 0.1}});
  problem.let("Ao", "[0, 1; 0, -0.1]").let("Bo", "[0; -g]").let("Gam", "[2*l; l^2]");
  problem.let("corr", "Gam*(x(1) - zh(1))").let("zs", "clip(zh, [-1; -12], [10; 12])");
  problem.state("x", {2, 1}, "[3; 0]").state("xi", {}, "0.5").flow("x", "Ao*x + Bo");
  problem.when("impact", "x(1) <= 0 and x(2) < 0");
  problem.jump("impact", {{"x", "[0; -xi*x(2) + ud]"}});
  problem.observer("o").state("zh", {2, 1}, "[1; -1]").state("xih", {}, "0").state("s", {}, "0");
  problem.flow("zh", "Ao*zh + Bo + corr").flow("xih", "Kd*expm(-Ao*s)*corr").flow("s", "1");
  problem.jump("impact", {{"zh", "[zs(1); -xih*zs(2) + ud]"}, {"s", "0"}});
  const hybrid::System system = problem.system();
  const auto impacts = jumps_of(judged_run(system, 6.5));
  const std::vector<double> times = {0.7927993446, 2.5253885325, 4.3326795194};
  const std::vector<double> velocities = {-7.4694335770, -8.2446572534, -8.5891230445};
  const std::vector<double> estimates = {0.1050528, 0.4005463, 0.4825424, 0.4975369};
  ASSERT_EQ(impacts.size(), 4U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(impacts[k].t, times[k], 1e-9);
    EXPECT_NEAR(part_of(system, impacts[k].before, "x")(1), velocities[k], 1e-8);
  }
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(part_of(system, impacts[k].before, "xih")(0), estimates[k], 1e-7);
}

/// Nominal and redesigned observers of a ball that is measured at its impacts.
EventProblem measured_ball(double restitution) {
  EventProblem problem;
  problem.data("r", restitution).data("g", 9.81);
  problem.data("P", Matrix{{0.2885, -0.0012}, {-0.0012, 0.2733}});
  problem.let("A", "[eye(2); -eye(2)]").let("b", "[10; 10; 0; 10]");
  problem.let("c(z)", "max(A*z - b, 0).^2");
  problem.let("corrected(z)", "[0; 0.1487*z(1) - r*z(2)]");
  problem.state("x", {2, 1}, "[4; 2]").flow("x", "[x(2); -g]");
  problem.when("impact", "x(1) <= 0 and x(2) < 0").jump("impact", {{"x", "[-x(1); -r*x(2)]"}});
  problem.observer("nominal").state("n", {2, 1}, "[1; -7]").flow("n", "[n(2); -g]");
  problem.jump("impact", {{"n", "corrected(n)"}});
  problem.observer("redesigned").state("m", {2, 1}, "[1; -7]");
  problem.flow("m", "[m(2); -g] - 10*inv(P)*jacobian(c(m), m)'*c(m)");
  problem.jump("impact", {{"m", "project_polytope(corrected(m), P, A, b)"}});
  return problem;
}

TEST(EventExamples, BallMeasuredAtImpacts) {
  struct Row {
    double restitution;
    std::vector<double> nominal, redesigned;
  };
  const std::vector<Row> rows = {
      {0.5, {1.7661, 0.2319, 0.0431, 0.0093}, {0.1103, 0.0145, 0.0027, 0.0006}},
      {0.8, {7.5102, 2.5241, 0.9822, 0.4266}, {0.3095, 0.1040, 0.0501, 0.0217}}};
  for (const Row& row : rows) {
    const hybrid::System system = measured_ball(row.restitution).system();
    const hybrid::Trajectory run = judged_run(system, 20);
    EXPECT_EQ(run.ending, hybrid::Ending::zeno);
    const double speed = std::sqrt(4 + 2 * 9.81 * 4);
    const double accumulation =
        (2 + speed) / 9.81 + 2 * speed / 9.81 * row.restitution / (1 - row.restitution);
    EXPECT_NEAR(run.accumulation, accumulation, 1e-6);
    const Matrix P = system.constants.at("P");
    const auto V = [&](const Eigen::VectorXd& values, const std::string& name) {
      const Matrix e = part_of(system, values, name) - part_of(system, values, "x");
      return (e.transpose() * P * e)(0);
    };
    const auto impacts = jumps_of(run);
    ASSERT_GE(impacts.size(), 4U);
    EXPECT_NEAR(V(impacts[0].before, "n"), 71.869, 1e-3);
    EXPECT_NEAR(V(impacts[0].before, "m"), 0.63819, 2e-5);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(V(impacts[k].after, "n"), row.nominal[k], 6e-5);
      EXPECT_NEAR(V(impacts[k].after, "m"), row.redesigned[k], 6e-5);
    }
  }
}

/// The Kalman-like observer in a box; `name` is that of its state, with S next to it.
EventProblem boxed(const std::string& correction) {
  EventProblem problem;
  problem.data("l", 20).data("gc", 20).data("eps", 0.8).data("eta", 5);
  problem.let("A(u)", "[0, u, 0; 0, 0, u; 0, 0, 0]").let("C", "[1, 0, 0]");
  problem.let("phi(z)",
              "[z(1) - z(1)^3/3; eps*(3*sin(z(1)) - z(2) - eta); "
              "z(3) - z(3)^5/5 + z(1)*z(2)/(1 + z(2)^2)]");
  problem.let("D", "diag([1; l; l^2])").let("box", "[eye(3); -eye(3)]").let("u", "cos(t)");
  problem.let("c(z)", "max(box*z - 8, 0).^2");
  problem.let("pull(z, S)", "-D*S*D*jacobian(c(z), z)'*c(z)");
  problem.let("gd", "0.99/(36*norm(D*S*D))");
  problem.state("x", {3, 1}, "[2; -2; -2]").flow("x", "A(u)*x + phi(x)");
  problem.observer("o").state("xh", {3, 1}, "[7; -7; 6]").symmetric("S", 3, "eye(3)");
  problem.flow("xh", "A(u)*xh + phi(clip(xh, -8, 8)) + l*D*S*C'*(C*x - C*xh)" + correction);
  problem.flow("S", "l*(He(A(u)*S) + eye(3) - 2*S*C'*C*S + S)");
  return problem;
}

TEST(EventExamples, HighGainObserverInABox) {
  const hybrid::System nominal = boxed("").system();
  const hybrid::Trajectory free = judged_run(nominal, 0.5);
  EXPECT_NEAR(peak(nominal, free, "xh", 1), 30.767, 1e-3);
  EXPECT_NEAR(peak(nominal, free, "xh", 2, 0.5), 7.787, 1e-3);
  const hybrid::System pulled = boxed(" + gc*pull(xh, S)").system();
  EXPECT_NEAR(peak(pulled, judged_run(pulled, 0.5), "xh", 1), 8.2426, 1e-3);

  EventProblem jumping = boxed("");
  jumping.when("outside", "max(abs(xh)) >= 11");
  EventProblem projected = jumping;
  projected.jump("outside", {{"xh", "project_polytope(xh, inv(D*S*D), box, 8*ones(6, 1))"}});
  const hybrid::System system = projected.system();
  const auto jumps = jumps_of(judged_run(system, 1));
  ASSERT_EQ(jumps.size(), 14U);
  EXPECT_NEAR(jumps[0].t, 0.016374, 1e-6);
  const Matrix before = part_of(system, jumps[0].before, "xh");
  const Matrix after = part_of(system, jumps[0].after, "xh");
  EXPECT_LT((before - Matrix{{4.66607}, {-11}, {-4.64519}}).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((after - Matrix{{4.69789}, {-8}, {8}}).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(EventExamples, ManyCorrectionsInOneJump) {
  EventProblem problem = boxed("");
  problem.when("outside", "max(abs(xh)) >= 11")
      .number(EventProblem::VariableKind::passes, "passes(outside)", "outside");
  problem.repeat("outside", {{"xh", "xh + gd*pull(xh, S)"}}, "norm(c(xh)) <= 1", "100000");
  const hybrid::System system = problem.system();
  const auto jumps = jumps_of(judged_run(system, 1));
  ASSERT_EQ(jumps.size(), 20U);
  double corrections = 0;
  for (const hybrid::JumpPoint& jump : jumps)
    corrections += part_of(system, jump.after, "passes(outside)")(0);
  EXPECT_NEAR(corrections, 74742, 20);
}

TEST(EventExamples, UnitingTwoObservers) {
  struct Row {
    double to_global, to_local;
    std::vector<double> times;
  };
  const std::vector<Row> rows = {{0.6, 0.8, {0.657795, 2.592897, 2.602897}},
                                 {0.4, 0.5, {1.762130, 2.401440, 2.411440}}};
  for (const Row& row : rows) {
    EventProblem problem;
    problem.data("c0p", row.to_global).data("c1p", row.to_local).data("k", 15);
    problem.let("wave(w)", "[cos(w*t); -sin(w*t)]").let("C", "[1, 0]");
    problem.let("v", "[0.99, 0.12; -0.12, 0.99]*wave(3) + [0.85, 0.53; -0.53, 0.85]*wave(27)");
    problem.let("y", "C*x + 0.5*[0.65, 0.76]*wave(32)").let("phi(z)", "z(1) - z(1)^3");
    problem.let("F(z)", "[z(2); phi(z)]");
    problem.state("x", {2, 1}, "[2; 3]").flow("x", "F(x) + 0.1*v");
    problem.observer("o").mode("q", "1").state("a", {2, 1}, "[-2; 1]");
    problem.symmetric("P", 2, "eye(2)").state("b", {2, 1}, "[-2; 1]");
    problem.state("z0", {}, "0").state("z1", {}, "1").state("s", {}, "0");
    problem.flow("a", "(1 - q)*(F(a) + P*C'*(y - C*a))");
    problem.flow("P", "(1 - q)*(He(jacobian(F(a), a)*P) - P*C'*C*P + 0.2*eye(2))");
    problem.flow("b", "[b(2); clip(phi(b), -210, 210)] + [k; k^2]*(y - C*b)");
    problem.flow("z0", "(1 - q)*(-z0 + abs(y - C*a))").flow("z1", "-z1 + abs(y - C*b)");
    problem.flow("s", "q");
    problem.when("to_global", "q == 0 and z0 >= c0p");
    problem.when("to_local", "q == 1 and z1 <= c1p and s >= 0.01");
    problem.jump("to_global", {{"z0", "0"}, {"s", "0"}, {"q", "1"}});
    problem.jump("to_local", {{"a", "b"}, {"P", "eye(2)"}, {"z0", "0"}, {"s", "0"}, {"q", "0"}});
    // Where it integrates across a kink of abs a step is off by some 1000 times the accuracy.
    const auto jumps = jumps_of(judged_run(problem.system(), 20, {1e-12, 1e-12}));
    ASSERT_EQ(jumps.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(jumps[i].t, row.times[i], 1e-6);
  }
}

}  // namespace
}  // namespace gainsmith::simulate
