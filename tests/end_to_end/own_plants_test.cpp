// The observers of the papers for plants that are in no paper: problems as their pages tell to write
// them. Of each method one plant is not for it and is refused with the assumption that it breaks.
#include "end_to_end/own_plants.h"

#include <algorithm>

#include "end_to_end/program.h"

namespace gainsmith::tests {
namespace {

TEST_P(OwnPlants, AreServedOrRefusedWithTheAssumption) {
  const Own& own = GetParam();
  const std::string text = "problem: " + own.name + "\nmethod: " + own.method + "\n" + own.text;
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 15) << "a page's example is short";
  const Folder folder;
  const Outcome outcome =
      gainsmith({"run", folder.file(own.name + ".yaml", text), "-o", folder.path("out")});
  if (own.refused.empty()) {
    EXPECT_EQ(outcome.exit, 0) << outcome.out << outcome.err;
    // coupled-gain has no runs.
    EXPECT_TRUE(has(outcome.out, "held in ") || has(outcome.out, "yes; no campaign"))
        << outcome.out;
  } else {
    EXPECT_NE(outcome.exit, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(has(outcome.out + outcome.err, own.refused)) << outcome.out << outcome.err;
  }
}

const std::string kStarts = "campaign: {runs: 10, horizon: 12, initial: {x: {box: [-1, 1]}}}\n";

INSTANTIATE_TEST_SUITE_P(
    HybridKalmanLike, OwnPlants,
    ::testing::Values(
        Own{"sampled", "hybrid-kalman-like",
            "data: {F: [[0, 1], [0, 0]], Hc: 'zeros(1, 2)', J: eye(2), Hd: [1, 0], T1: 0.1, T2: "
            "0.5}\n" +
                kStarts,
            ""},
        Own{"impacts", "hybrid-kalman-like",
            "data: {F: [[0, 1], [-4, -0.1]], Hc: [1, 0], J: [[1, 0], [0, -0.8]], T1: 0.1, T2: "
            "0.5}\n" +
                kStarts,
            ""},
        Own{"unstable", "hybrid-kalman-like",
            "data: {F: [[0.3, 1], [0, 0.2]], Hc: [1, 0], J: [[0.5, 0.1], [0, 1.1]], Hd: [0, 1], "
            "T1: 0.2, T2: 1}\n"
            "parameters: {gamma: 0.5}\n" +
                kStarts,
            ""},
        Own{"unknown_reset", "hybrid-kalman-like",
            "data:\n  F: [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]\n  Hc: [0, 1, 0]\n"
            "  J: [[0, 0, 1], [0, 1, 0], [0, 0, 1]]\n  T1: 0.3\n  T2: 1\n" +
                kStarts,
            ""},
        Own{"clock_in_seconds", "hybrid-kalman-like",
            "data: {F: 'zeros(2)', Hc: [1, 0], J: eye(2), Hd: [0, 299792458], T1: 0.9, T2: 1.1}\n"
            "campaign: {runs: 5, horizon: 20, initial: {x: {box: [[-1, -1e-6], [1, 1e-6]]}}}\n",
            ""},
        Own{"unseen_at_one_length", "hybrid-kalman-like",
            "data:\n  F: [[-0.5, 0, 0], [0, 0, 2], [0, -2, 0]]\n  Hc: [1, 0, 0]\n"
            "  J: [[0.9, 1, 0], [0, 1, 0], [0, 0, 1]]\n  T1: 1\n  T2: 2.5\n" +
                kStarts,
            "uniformly observable cannot hold"},
        Own{"never_shown", "hybrid-kalman-like",
            "data: {F: [[-1, 0], [0, 0.5]], Hc: [1, 0], J: eye(2), T1: 0.3, T2: 1}\n" + kStarts,
            "uniformly observable cannot hold"},
        Own{"jumps_without_flows", "hybrid-kalman-like",
            "data: {F: [[0, 1], [-1, 0]], Hc: 'zeros(1, 2)', J: [[0.9, 0.5], [-0.5, 0.9]], Hd: [1, "
            "0], T1: 0, T2: 0.4}\n" +
                kStarts,
            ""},
        Own{"jumps_without_flows_show_nothing", "hybrid-kalman-like",
            "data: {F: [[0, 1], [-1, 0]], Hc: [1, 0], J: eye(2), T1: 0, T2: 0.4}\n" + kStarts,
            "uniformly observable cannot hold"},
        Own{"turning_rate", "hybrid-kalman-like-varying",
            "data:\n  known(t): 2 + sin(t)\n  F(v): '[0, -v; v, 0]'\n  Hc(v): '[1, 0]'\n"
            "  J(v): '[1, 0; 0, v/2]'\n  T1: 0.3\n  T2: 1\n" +
                kStarts,
            ""},
        Own{"damping_that_varies", "hybrid-kalman-like-varying",
            "data: {known(t): cos(t), F(v): '[0, 1; -2, -0.3*(1 + v)]', Hc(v): '[1, 0]', J(v): "
            "'[1, "
            "0; 0, -0.8]', T1: 0.3, T2: 1}\n" +
                kStarts,
            ""},
        Own{"sensor_that_varies", "hybrid-kalman-like-varying",
            "data: {known(t): 1 + 0.5*sin(3*t), F(v): '[0, 1; -1, 0]', Hc(v): '[v, 0]', J(v): "
            "eye(2), T1: 0.3, T2: 1}\n" +
                kStarts,
            ""},
        Own{"unknown_load_at_samples", "hybrid-kalman-like-varying",
            "data: {known(t): sin(t), F(v): '[0, 1, v; 0, 0, 1; 0, 0, 0]', Hc(v): 'zeros(1, 3)', "
            "J(v): eye(3), Hd(v): '[1, 0, 0]', T1: 0.3, T2: 0.6}\nparameters: {gamma: 0.7}\n" +
                kStarts,
            ""},
        Own{"forgets_too_much", "hybrid-kalman-like-varying",
            "data:\n  known(t): 2 + sin(t)\n  F(v): '[0, -v; v, 0]'\n  Hc(v): '[1, 0]'\n"
            "  J(v): eye(2)\n  T1: 0.3\n  T2: 1\nparameters: {gamma: 1.5}\n" +
                kStarts,
            "the assumption 'factor'"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    HybridKkl, OwnPlants,
    ::testing::Values(
        Own{"unknown_reset", "hybrid-kkl",
            "data:\n  F: [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]\n  Hc: [0, 1, 0]\n"
            "  J: [[0, 0, 1], [0, 1, 0], [0, 0, 1]]\n  T1: 0.3\n  T2: 1\nparameters: {lambda: "
            "40}\n" +
                kStarts,
            ""},
        Own{"two_hidden", "hybrid-kkl",
            "data:\n  F: [[0.2, 0, 0], [0, 0.1, 1], [0, -1, 0]]\n  Hc: [1, 0, 0]\n"
            "  J: [[0.5, 1, 0], [0, 0.9, 0], [0.1, 0, 0.8]]\n  T1: 0.4\n  T2: 0.9\nparameters: "
            "{lambda: 10}\n"
            "campaign: {runs: 10, horizon: 20, initial: {x: {box: [-1, 1]}}}\n",
            ""},
        Own{"shown_at_jumps", "hybrid-kkl",
            "data:\n  F: [[0, 1, 0], [-2, -0.1, 0], [0, 0, -0.1]]\n  Hc: [1, 0, 0]\n"
            "  J: [[1, 0, 0], [0, -0.9, 0.5], [0, 0, 1]]\n  Hd: [0, 0, 1]\n  T1: 0.5\n  T2: 1\n"
            "  uc(t, y): '[0; -y^3; 0]'\nparameters: {gamma: 0.5, lambda: 10}\n" +
                kStarts,
            ""},
        Own{"jumps_forget", "hybrid-kkl",
            "data:\n  F: [[0, 1, 0], [-2, -0.1, 0], [0, 0, -0.1]]\n  Hc: [1, 0, 0]\n"
            "  J: [[1, 0, 1], [0, -0.9, 0.5], [0.2, 0, 0]]\n  T1: 0.5\n  T2: 1\n" +
                kStarts,
            "the assumption 'jumps keep the hidden part'"},
        Own{"nothing_hidden", "hybrid-kkl",
            "data: {F: [[0, 1], [-4, -0.1]], Hc: [1, 0], J: eye(2), T1: 0.1, T2: 0.5}\n" + kStarts,
            "the assumption 'hidden'"},
        Own{"never_seen", "hybrid-kkl",
            "data:\n  F: 'blkdiag(0, [0, -1; 1, 0])'\n  Hc: [1, 0, 0]\n  J: eye(3)\n"
            "  Hd: [0, 0, 0]\n  T1: 0.5\n  T2: 1\n" +
                kStarts,
            "backward distinguishable cannot hold"}),
    name_of);

const std::string kBall =
    "data:\n"
    "  low:  [-1, -15]\n"
    "  high: [10, 15]\n"
    "  fo(z, t): \"[z(2); -9.81]\"\n"
    "  guard(z): z\n";
const std::string kFlights =
    "  T1:   0.3\n"
    "  T2:   3\n"
    "campaign: {runs: 5, horizon: 12, initial: {zo: [3, 0], xi: {box: [3, 5]}}}\n";

INSTANTIATE_TEST_SUITE_P(
    CoupledObserver, OwnPlants,
    ::testing::Values(
        Own{"unknown_kick", "coupled-observer",
            kBall +
                "  Ano:  0\n"
                "  Jo(z, t): \"[z(1); -0.5*z(2)]\"\n"
                "  Jono(z): \"[0; 1]\"\n" +
                kFlights,
            ""},
        // (14): the first state grows at a rate that varies with time and output
        Own{"varying_chain", "coupled-observer",
            "data:\n"
            "  low:  [-1, -20]\n"
            "  high: [30, 20]\n"
            "  fo(z, t): \"[(1.5 + 0.5*sin(3*t) + 0.05*z(1))*z(2); -9.81]\"\n"
            "  Av(y, t): \"[0, 1.5 + 0.5*sin(3*t) + 0.05*y; 0, 0]\"\n"
            "  guard(z): z\n"
            "  Ano:  0\n"
            "  Jo(z, t): \"[z(1); -0.5*z(2)]\"\n"
            "  Jono(z): \"[0; 1]\"\n" +
                kFlights,
            ""},
        Own{"chain_that_is_not_stable", "coupled-observer",
            kBall +
                "  Ano:  0\n"
                "  Jo(z, t): \"[z(1); -0.5*z(2)]\"\n"
                "  Jono(z): \"[0; 1]\"\n"
                "  K:    [[-2], [1]]\n" +
                kFlights,
            "the assumption 'stable chain'"},
        Own{"integrate_and_fire", "coupled-observer",
            "data:\n"
            "  low:  -2\n"
            "  high: 2\n"
            "  fo(z, t): 3 - z + 0.3*sin(t)\n"
            "  guard(z): 1 - z\n"
            "  Ano:  0\n"
            "  Jo(z, t): 0\n"
            "  Jono(z): 1\n"
            "  T1:   0.2\n"
            "  T2:   2\n"
            "campaign: {runs: 5, horizon: 8, initial: {zo: 0, xi: {box: [-1, 0.5]}}}\n",
            ""},
        Own{"turning_part", "coupled-observer",
            "data:\n"
            "  low:  [-6, -6]\n"
            "  high: [6, 6]\n"
            "  fo(z, t): \"[z(2); -4*sin(z(1)) - 0.1*z(2)]\"\n"
            "  guard(z): \"[z(1); z(2)]\"\n"
            "  Ano:  [[0, 1], [-1, 0]]\n"
            "  Jo(z, t): \"[z(1); -0.6*z(2) + 0.5]\"\n"
            "  Jono(z): \"[0, 0; 0.3, 0.1]\"\n"
            "  T1:   0.5\n"
            "  T2:   1.5\n"
            "parameters: {rho: 0.85, shrink: 0.4}\n"
            "campaign: {runs: 2, horizon: 12, initial: {zo: [1.2, 0], xi: {box: [-1, 1]}}}\n",
            ""},
        Own{"shown_by_a_sensor", "coupled-observer",
            kBall +
                "  Ano:  -0.1\n"
                "  Jo(z, t): \"[z(1); -0.5*z(2) + 4]\"\n"
                "  Jono(z): \"[0; 0]\"\n"
                "  Hdno(z): 2\n" +
                kFlights,
            ""},
        Own{"shown_by_nothing", "coupled-observer",
            kBall +
                "  Ano:  0\n"
                "  Jo(z, t): \"[z(1); -0.5*z(2) + 4]\"\n"
                "  Jono(z): \"[0; 0]\"\n" +
                kFlights,
            "infeasible: contraction cannot hold"}),
    name_of);

const std::string kPendulum =
    "let: {f0(x): \"[x(2); -4*sin(x(1)) - 0.1*x(2)]\"}\n"
    "data:\n"
    "  x0: [2, 0]\n"
    "  zeta0: [-1, 2]\n"
    "  f(x, t): f0(x)\n"
    "  y(x, t): x(1) + 0.02*sin(50*t)\n"
    "  h(x): x(1)\n"
    "  phi0(z, y, t): \"f0(z) + [1; 0.5]*(y - z(1))\"\n"
    "  phi1(z, y, t): \"f0(z) + [20; 100]*(y - z(1))\"\n";
const std::string kSwitches =
    "parameters: {c0: 0.3, c1: 0.1}\n"
    "campaign: {runs: 1, horizon: 20}\n";

INSTANTIATE_TEST_SUITE_P(
    UnitingObservers, OwnPlants,
    ::testing::Values(
        Own{"two_gains", "uniting-observers",
            "data:\n"
            "  x0: [1, 0]\n"
            "  zeta0: [-3, 1]\n"
            "  f(x, t): \"[x(2); -x(1)]\"\n"
            "  y(x, t): x(1) + 0.05*sin(40*t)\n"
            "  h(x): x(1)\n"
            "  phi0(z, y, t): \"[z(2); -z(1)] + [0.4; 0.1]*(y - z(1))\"\n"
            "  phi1(z, y, t): \"[z(2); -z(1)] + [20; 99]*(y - z(1))\"\n"
            "parameters: {c0: 0.3, c1: 0.1, c0_compared: 0.3}\n"
            "campaign: {runs: 1, horizon: 20}\n",
            ""},
        Own{"pendulum", "uniting-observers", kPendulum + kSwitches, ""},
        Own{"filter_of_another_size", "uniting-observers",
            "data:\n"
            "  x0: 2\n"
            "  zeta0: 0\n"
            "  zeta1: [0, 0]\n"
            "  f(x, t): -x + sin(t)\n"
            "  y(x, t): x + 0.1*sin(30*t)\n"
            "  h(x): x\n"
            "  phi0(z, y, t): -z + sin(t) + 0.2*(y - z)\n"
            "  phi1(z, y, t): \"[-z(1) + z(2) + sin(t) + 8*(y - z(1)); 15*(y - z(1))]\"\n"
            "  restart(z): z(1)\n"
            "parameters: {c0: 0.4, c1: 0.15}\n"
            "campaign: {runs: 1, horizon: 15}\n",
            ""},
        Own{"bank_of_local_observers", "uniting-observers",
            kPendulum + "  restart(z): \"[z, z + [0; 1], z - [0; 1]]\"\n" + kSwitches, ""},
        Own{"restarted_elsewhere", "uniting-observers",
            kPendulum + "  restart(z): \"[0; 0]\"\n" + kSwitches,
            "the assumption 'restart keeps the estimate'"},
        Own{"bank_without_the_estimate", "uniting-observers",
            kPendulum + "  restart(z): \"[z + [0; 1], z]\"\n" + kSwitches,
            "the assumption 'restart keeps the estimate'"},
        Own{"never_left", "uniting-observers",
            "data:\n"
            "  x0: 1\n"
            "  zeta0: 0\n"
            "  f(x, t): 0.5*cos(t)\n"
            "  y(x, t): x\n"
            "  h(x): x\n"
            "  phi0(z, y, t): 0.5*cos(t) + (y - z)\n"
            "  phi1(z, y, t): 0.5*cos(t) + 30*(y - z)\n"
            "parameters: {c0: -1, c1: 0.2}\n"
            "campaign: {runs: 1, horizon: 15}\n",
            "the assumption 'thresholds'"}),
    name_of);

const std::string kSampled =
    "data:\n"
    "  a:   \"[eye(2); -eye(2)]\"\n"
    "  b:   1.5*ones(4, 1)\n"
    "  f(x, t): \"[x(2); -x(1)]\"\n"
    "  hd(x, t): x(1)\n"
    "  G(xh, S, y, t): \"xh + [0.8; 0.3]*(y - xh(1))\"\n"
    "  invP(S): eye(2)\n";

/// An oscillator that is to stay in the square of half-width 2.
std::string luenberger(const std::string& x0) {
  return "data:\n"
         "  x0:    " +
         x0 +
         "\n"
         "  xh0:   [-1.5, 1.5]\n"
         "  a:     \"[eye(2); -eye(2)]\"\n"
         "  b:     2*ones(4, 1)\n"
         "  outer: 4*ones(4, 1)\n"
         "  f(x, t): \"[x(2); -x(1)]\"\n"
         "  h(x, t): x(1)\n"
         "  F(xh, S, y, t): \"[xh(2); -xh(1)] + [20; 99]*(y - xh(1))\"\n"
         "  invP(S): \"inv(lyap([-20, 1; -100, 0]', [1, 0; 0, 0.01]))\"\n"
         "campaign: {runs: 1, horizon: 3}\n";
}

INSTANTIATE_TEST_SUITE_P(
    ConstrainedRedesign, OwnPlants,
    ::testing::Values(
        Own{"luenberger", "constrained-redesign",
            luenberger("[1, 0]") + "parameters: {gamma_c: 50}\n", ""},
        Own{"weak_pull",
            "{like: constrained-redesign, claims: {kept_by_pull: none, projected: {below: "
            "\"max(abs(flow_and_jumps.xh))\", bound: 2 + 1e-9, over: flow_and_jumps.outside}}}",
            luenberger("[1, 0]") + "parameters: {gamma_c: 0.005}\n", ""},
        Own{"cut_disc",
            "{like: constrained-redesign, let: {limits(x): \"[x'*x/4 - 1; x(1) + x(2) - 2.5]\"}, "
            "claims: {kept_by_pull: none, projected: {below: \"max(limits(projected.xh))\", "
            "bound: 1e-9, over: projected.outside}}}",
            luenberger("[1, 0]") + "parameters: {gamma_c: 50, delta_max: 40}\n", ""},
        Own{"starts_outside_of_the_disc",
            "{like: constrained-redesign, let: {limits(x): \"x'*x*4 - 1\"}}",
            luenberger("[1, 0]") + "parameters: {gamma_c: 50, delta_max: 40}\n",
            "the assumption 'the plant starts in the set'"},
        Own{"half_plane", "constrained-redesign",
            "let: {A: \"[-0.3, 0.2; 0, -0.2]\", L: \"[4; 3]\"}\n"
            "data:\n"
            "  x0:    [2, 1]\n"
            "  xh0:   [0.5, 3]\n"
            "  a:     [[-1, 0]]\n"
            "  b:     [0]\n"
            "  outer: [1]\n"
            "  f(x, t): A*x\n"
            "  h(x, t): x(1)\n"
            "  F(xh, S, y, t): A*xh + L*(y - xh(1))\n"
            "  invP(S): \"inv(lyap((A - L*[1, 0])', eye(2)))\"\n"
            "campaign: {runs: 1, horizon: 3}\n",
            ""},
        Own{"outside", "constrained-redesign", luenberger("[3, 0]"),
            "the assumption 'the plant starts in the set'"},
        Own{"kalman_in_steps", "{like: constrained-redesign-jumps, events: {jump: {every: 1}}}",
            "let: {A: \"[0.9, 0.4; -0.4, 0.9]\", C: \"[1, 0]\", K(S): \"A*S*C'/(C*S*C' + 0.1)\"}\n"
            "data:\n"
            "  x0:  [1, 0]\n"
            "  xh0: [-3, 3]\n"
            "  a:   \"[eye(2); -eye(2)]\"\n"
            "  b:   1.5*ones(4, 1)\n"
            "  S0:  eye(2)\n"
            "  g(x, t): A*x\n"
            "  hd(x, t): C*x\n"
            "  G(xh, S, y, t): A*xh + K(S)*(y - C*xh)\n"
            "  nextS(xh, S, t): \"(A - K(S)*C)*S*(A - K(S)*C)' + 0.1*K(S)*K(S)' + 0.01*eye(2)\"\n"
            "  invP(S): S\n"
            "campaign: {runs: 1, horizon: 30}\n",
            ""},
        Own{"outside_between_samples",
            "{like: constrained-redesign-jumps, events: {jump: {every: 0.5}}}",
            kSampled + "  x0:  [2, 0]\n  xh0: [0, 0]\ncampaign: {runs: 1, horizon: 5}\n",
            "the assumption 'the plant starts in the set'"},
        Own{"floor_and_impacts",
            "{like: constrained-redesign-jumps, events: {jump: {every: [0.3, 0.6]}}}",
            "data:\n"
            "  a:   [[-1, 0]]\n"
            "  b:   [0]\n"
            "  f(x): \"[-0.2, 0.1; 0, -0.1]*x\"\n"
            "  hd(x): x(1)\n"
            "  g(x): \"[x(1); 0.8*x(2)]\"\n"
            "  G(xh, S, y): \"[1, 0; 0, 0.8]*(xh + [0.5; 0.2]*(y - xh(1)))\"\n"
            "  invP(S): eye(2)\n"
            "  x0:  [2, 1]\n"
            "  xh0: [-1, 0]\n"
            "parameters: {rho: 100}\n"
            "campaign: {runs: 5, horizon: 15}\n",
            ""},
        Own{"ellipse_at_samples",
            "{like: constrained-redesign-jumps, events: {jump: {every: [0.2, 0.5]}}, let: "
            "{limits(x): x(1)^2/2.25 + x(2)^2/4 - 1}}",
            kSampled + "  x0:  [1, 0]\n"
                       "  xh0: [-3, 3]\n"
                       "parameters: {rho: 100}\n"
                       "campaign: {runs: 5, horizon: 15}\n",
            ""},
        Own{"samples", "{like: constrained-redesign-jumps, events: {jump: {every: [0.2, 0.5]}}}",
            kSampled + "  x0:  [1, 0]\n"
                       "  xh0: [-3, 3]\n"
                       "parameters: {rho: 100}\n"
                       "campaign: {runs: 5, horizon: 15}\n",
            ""}),
    name_of);

}  // namespace
}  // namespace gainsmith::tests
