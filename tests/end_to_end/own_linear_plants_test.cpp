// Own plants of the designs by inequalities, of coupled observers that vary and of their gains: see
// own_plants_test.cpp.
#include "end_to_end/own_plants.h"

namespace gainsmith::tests {
namespace {

const std::string kHeld =
    "campaign: {runs: 10, horizon: 20, initial: {z: {box: [-1, 1]}, zh: 0, th: C*z}}\n";
const std::string kReset =
    "campaign: {runs: 10, horizon: 20, initial: {z: {box: [-1, 1]}, zh: 0}}\n";
const std::string kBothStates = "campaign: {runs: 10, horizon: 20, initial: {x: {box: [-1, 1]}}}\n";

INSTANTIATE_TEST_SUITE_P(
    SampledDataHybrid, OwnPlants,
    ::testing::Values(Own{"double_integrator", "sampled-data-hybrid",
                          "data: {A: [[0, 1], [0, 0]], C: [1, 0], T1: 0.1, T2: 0.3, QF: I}\n"
                          "parameters: {a1: 0.1}\n" +
                              kHeld,
                          ""},
                      Own{"oscillator", "sampled-data-hybrid",
                          "data: {A: [[0, 1], [-4, -0.2]], C: [1, 0], T1: 0.1, T2: 0.25, QF: I}\n"
                          "parameters: {a1: 1, a2: 1}\n" +
                              kHeld,
                          ""},
                      Own{"unstable", "sampled-data-hybrid",
                          "data: {A: 0.5, C: 1, T1: 0.1, T2: 0.4}\n"
                          "parameters: {a1: 1, a2: 1}\n" +
                              kHeld,
                          ""},
                      Own{"two_outputs", "sampled-data-hybrid",
                          "data: {A: [[-1, 1, 0], [0, -0.5, 1], [0, -1, -0.5]], C: [[1, 0, 0], [0, "
                          "1, 0]], T1: 0.2, T2: 0.4}\n"
                          "parameters: {a1: 1, a2: 1}\n" +
                              kHeld,
                          ""},
                      Own{"hidden_mode", "sampled-data-hybrid",
                          "data: {A: [[0.5, 0], [0, -1]], C: [0, 1], T1: 0.1, T2: 0.4}\n" + kHeld,
                          "the output does not show a mode"},
                      Own{"samples_in_the_wrong_order", "sampled-data-hybrid",
                          "data: {A: 0.5, C: 1, T1: 0.4, T2: 0.1}\n" + kHeld,
                          "the assumption 'sampling'"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    ResetObserver, OwnPlants,
    ::testing::Values(
        Own{"double_integrator", "reset-observer",
            "data: {A: [[0, 1], [0, 0]], C: [1, 0], T1: 0.1, T2: 1}\n" + kReset, ""},
        Own{"oscillator", "reset-observer",
            "data: {A: [[0, 1], [-4, 0.2]], C: [1, 0], T1: 0.2, T2: 1}\n" + kReset, ""},
        Own{"unstable", "reset-observer", "data: {A: 0.5, C: 1, T1: 0.1, T2: 3}\n" + kReset, ""},
        Own{"gain_of_the_interval", "reset-observer",
            "data: {A: [[0, 1], [-1, 0.1]], C: [0, 1], T1: 0.3, T2: 2}\n"
            "parameters: {degree: 2}\n" +
                kReset,
            ""},
        Own{"hidden_mode", "reset-observer",
            "data: {A: [[0.5, 0], [0, -1]], C: [0, 1], T1: 0.1, T2: 0.4}\n" + kReset,
            "the output does not show a mode"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Detectability, OwnPlants,
    ::testing::Values(
        Own{"unknown_reset", "detectability",
            "data:\n"
            "  F: [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]\n"
            "  Hc: [0, 1, 0]\n"
            "  J: [[0, 0, 1], [0, 1, 0], [0, 0, 1]]\n"
            "  T1: 0.3\n"
            "  T2: 1\n"
            "parameters: {lambda: 40}\n" +
                kBothStates,
            ""},
        Own{"two_hidden", "detectability",
            "data:\n"
            "  F: [[0.2, 0, 0], [0, 0.1, 1], [0, -1, 0]]\n"
            "  Hc: [1, 0, 0]\n"
            "  J: [[0.5, 1, 0], [0, 0.9, 0], [0.1, 0, 0.8]]\n"
            "  T1: 0.4\n"
            "  T2: 0.9\n"
            "parameters: {lambda: 10}\n" +
                kBothStates,
            ""},
        Own{"shown_at_jumps", "detectability",
            "data:\n"
            "  F: [[0, 1, 0], [-2, -0.1, 0], [0, 0, 0.1]]\n"
            "  Hc: [1, 0, 0]\n"
            "  J: [[1, 0, 0], [0, -0.9, 0.5], [0, 0, 1]]\n"
            "  Hd: [0, 0, 1]\n"
            "  T1: 0.5\n"
            "  T2: 1\n"
            "parameters: {lambda: 10}\n" +
                kBothStates,
            ""},
        Own{"gain_of_the_flow", "detectability",
            "data:\n"
            "  F: [[-0.5, 0, 0], [0, 0, 1], [0, -1, 0]]\n"
            "  Hc: [1, 0, 0]\n"
            "  J: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
            "  Hd: [0, 1, 0]\n"
            "  T1: 0.3\n"
            "  T2: 1\n"
            "parameters: {degree: 1, lambda: 10}\n" +
                kBothStates,
            ""},
        Own{"nothing_hidden", "detectability",
            "data: {F: [[0, 1], [-4, -0.1]], Hc: [1, 0], J: eye(2), T1: 0.1, T2: 0.5}\n" +
                kBothStates,
            "the assumption 'hidden'"},
        Own{"never_shown", "detectability",
            "data:\n"
            "  F: 'blkdiag(0, [0, -1; 1, 0])'\n"
            "  Hc: [1, 0, 0]\n"
            "  J: eye(3)\n"
            "  T1: 0.5\n"
            "  T2: 1\n" +
                kBothStates,
            "contraction"}),
    name_of);

const std::string kFall =
    "data: {low: [-1, -20], high: [30, 20], fo(z): '[z(2); -9.81]', guard(z): z, Ano: 0";
// One gain for all speeds reaches a factor of 1/2, one that depends on the speed less.
const std::string kSpeedSensor =
    kFall +
    ",\n  Jo(z): '[z(1); 4 - 0.5*z(2)]', Jono(z): 'zeros(2, 1)', Hdno(z): 3 + 0.2*z(2),\n"
    "  from: [-1, -10], to: [1, 0], T1: 0.1, T2: 4";
const std::string kSpeeds =
    "}\nparameters: {rho: 0.3}\n"
    "campaign: {runs: 5, horizon: 15, initial: {zo: [4, 0], xi: {box: [0.5, 2]}}}\n";

INSTANTIATE_TEST_SUITE_P(
    CoupledObserverThatVaries, OwnPlants,
    ::testing::Values(
        Own{"output_that_varies", "coupled-observer",
            "data:\n"
            "  low:  [-1, -15]\n"
            "  high: [10, 15]\n"
            "  fo(z, t): \"[z(2); -9.81]\"\n"
            "  Hv(t): \"[1 + 0.5*sin(t), 0]\"\n"
            "  guard(z): z\n"
            "  Ano:  0\n"
            "  Jo(z, t): \"[z(1); -0.5*z(2)]\"\n"
            "  Jono(z): \"[0; 1]\"\n"
            "  T1:   0.3\n"
            "  T2:   3\n"
            "campaign: {runs: 5, horizon: 12, initial: {zo: [3, 0], xi: {box: [3, 5]}}}\n",
            ""},
        Own{"sensor_gain_of_the_flow", "coupled-observer",
            "data:\n"
            "  low:  [-1, -15]\n"
            "  high: [10, 15]\n"
            "  fo(z, t): \"[z(2); -9.81]\"\n"
            "  guard(z): z\n"
            "  Ano:  [[0, 1], [-1, 0]]\n"
            "  Jo(z, t): \"[z(1); -0.5*z(2) + 4]\"\n"
            "  Jono(z): zeros(2)\n"
            "  Hdno(z): \"[1, 0]\"\n"
            "  T1:   0.5\n"
            "  T2:   1.5\n"
            "parameters: {degree: 2, rho: 0.5}\n"
            "campaign: {runs: 5, horizon: 12, initial: {zo: [3, 0], xi: {box: [-1, 1]}}}\n",
            ""},
        // (18), (19): Jono depends on a known input at jumps, Ld on zo.
        Own{"input_at_jumps", "coupled-observer",
            kFall +
                ",\n  input(t): 2 + sin(t), input_low: 1, input_high: 3,\n"
                "  Jo(z): '[z(1); -0.5*z(2)]', 'Jono(z, u)': '[0; u]', T1: 0.5, T2: 3}\n"
                "parameters: {rho: 0.6}\n"
                "campaign: {runs: 5, horizon: 15, initial: {zo: [10, 0], xi: {box: [0.5, 2]}}}\n",
            ""},
        Own{"sensor_that_depends_on_speed", "coupled-observer",
            kSpeedSensor + ", Ld_terms(z): '[z(2); z(2)^2]'" + kSpeeds, ""},
        Own{"sensor_that_depends_on_speed_with_one_gain", "coupled-observer",
            kSpeedSensor + kSpeeds, "infeasible: contraction cannot hold"}),
    name_of);

const std::string kImpacts =
    "data:\n"
    "  Ao: [[0, 1], [0, -0.1]]\n"
    "  Ano: 0\n"
    "  Jo(z): '[z(1); 5]'\n"
    "  Jono(z): '[0; -z(2)]'\n"
    "  from: [0, -8]\n"
    "  to: [0, -2]\n"
    "  xi_low: 0\n"
    "  xi_high: 1\n"
    "  Kd: [[0, 0.2]]\n"
    "  T2: 2\n";

INSTANTIATE_TEST_SUITE_P(
    CoupledGain, OwnPlants,
    ::testing::Values(
        Own{"ball", "coupled-gain", kImpacts + "  T1: 1\nparameters: {l: 15, lc: 1.4}\n", ""},
        Own{"far_above_the_least_gain", "coupled-gain",
            kImpacts + "  T1: 1\nparameters: {l: 100, lc: 1.4}\n", ""},
        Own{"turns", "coupled-gain",
            "data: {Ao: -0.2, Ano: [[0, -2], [2, 0]], Jo(z): 0.5*z, Jono(z): '[1, 0]', from: -2, "
            "to: 2, xi_low: [-1, -1], xi_high: [1, 1], T1: 0.3, T2: 0.6, Kd: [[0.5], [0]]}\n"
            "parameters: {l: 30}\n",
            ""},
        Own{"damped_turns", "coupled-gain",
            "data: {Ao: -0.2, Ano: [[-0.2, 1], [-1, -0.2]], Jo(z): 0.5*z, Jono(z): '[1, 0]', "
            "from: -2, to: 2, xi_low: [-1, -1], xi_high: [1, 1], T1: 0.3, T2: 0.6, Kd: [[0.2], "
            "[0]]}\n"
            "parameters: {l: 30}\n",
            ""},
        Own{"shown_at_jumps", "coupled-gain",
            "data: {Ao: [[0, 1], [-1, 0]], Ano: -0.1, Jo(z): '[z(1); -0.5*z(2)]', Jono(z): '[0; "
            "0]', Hdno(z): 1, from: [-1, -1], to: [1, 1], xi_low: -1, xi_high: 1, T1: 1, T2: 2, "
            "Kd: [[0, 0]], Ld: 0.5}\n",
            ""},
        Own{"jumps_without_flows", "coupled-gain", kImpacts + "  T1: 0\n",
            "the assumption 'flows'"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    SampledDataNoise, OwnPlants,
    ::testing::Values(
        Own{"double_integrator", "sampled-data-noise",
            "data: {A: [[0, 1], [0, 0]], B: [[0], [1]], C: [[1, 0]], D: 0.2, T1: 0.1, T2: 0.3}\n"
            "campaign: {runs: 20, horizon: 40}\n"
            "compare: [{at: {t: 40}, value: sqrt(error/spent)}, {at: {t: 40}, value: "
            "gain/sqrt(error/spent)}]\n",
            ""},
        Own{"oscillator", "sampled-data-noise",
            "data: {A: [[0, 1], [-4, -0.2]], B: [[0], [1]], C: [[1, 0]], D: 0.1, T1: 0.1, T2: "
            "0.25}\n"
            "campaign: {runs: 20, horizon: 40}\n"
            "compare: [{at: {t: 40}, value: sqrt(error/spent)}, {at: {t: 40}, value: "
            "gain/sqrt(error/spent)}]\n",
            ""},
        Own{"unstable", "sampled-data-noise",
            "data: {A: 0.5, B: 1, C: 1, D: 1, T1: 0.1, T2: 0.4}\n"
            "campaign: {runs: 20, horizon: 40}\n"
            "compare: [{at: {t: 40}, value: sqrt(error/spent)}, {at: {t: 40}, value: "
            "gain/sqrt(error/spent)}]\n",
            ""},
        Own{"two_outputs", "sampled-data-noise",
            "data: {A: [[-1, 1, 0], [0, -0.5, 1], [0, -1, -0.5]], B: \"[eye(2); zeros(1, 2)]\", C: "
            "[[1, 0, 0], [0, 1, 0]], D: 0.1*eye(2), T1: 0.2, T2: 0.6}\n"
            "campaign: {runs: 20, horizon: 40}\n"
            "compare: [{at: {t: 40}, value: sqrt(error/spent)}, {at: {t: 40}, value: "
            "gain/sqrt(error/spent)}]\n",
            ""},
        Own{"hidden_mode", "sampled-data-noise",
            "data: {A: [[0.5, 0], [0, -1]], B: [[0], [1]], C: [[0, 1]], D: 0.1, T1: 0.2, T2: 0.6}\n"
            "campaign: {runs: 20, horizon: 40}\n"
            "compare: [{at: {t: 40}, value: sqrt(error/spent)}, {at: {t: 40}, value: "
            "gain/sqrt(error/spent)}]\n",
            "infeasible: the output does not show a mode"}),
    name_of);

}  // namespace
}  // namespace gainsmith::tests
