// What campaigns draw for methods with events: starts, sinusoids, vertices; and that runs replay.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "bind/stated.h"
#include "claims/run_setup.h"
#include "io/problem_text.h"
#include "statistics/figure_survey.h"
#include "support/linear_algebra.h"

namespace gainsmith::verify {
namespace {

using Eigen::VectorXd;

model::Instance instance_of(const std::string& method, const std::string& problem) {
  return bind::bind(io::read_problem("problem: p\nmethod:\n  method: m\n" + method + problem));
}

std::unique_ptr<const claims::RunSetup> setup_of(const std::string& method,
                                                 const std::string& problem) {
  return claims::make_run_setup(bind::run_texts(instance_of(method, problem), {}));
}

const std::string kPlant =
    R"(  data: {Q: {shape: 3 x 3, default: "[4, 1, 0; 1, 2, 0.5; 0, 0.5, 1]"}}
  plant: {state: {x: {shape: 3}}}
  observers:
    a: {state: {z: {shape: 2}}}
    b: {state: {z: {shape: 2}}}
  claims: {c: {below: norm(x), bound: 1e9}}
)";

VectorXd part(const claims::RunSetup& setup, const VectorXd& values, const std::string& name) {
  const hybrid::Slot& slot = setup.system.layout.slots[setup.system.slot(name).value()];
  return values.segment(slot.offset, slot.shape.size());
}

VectorXd start(const claims::RunSetup& setup, std::uint64_t seed, std::uint64_t run) {
  return hybrid::draw_start(setup.system, setup.scenario, seed, run);
}

TEST(EventDraws, AnEllipsoidIsFilledEvenly) {
  const auto setup =
      setup_of(kPlant,
               "campaign: {horizon: 1, initial: {x: {ellipsoid: {center: [1, 2, 3], matrix: Q, "
               "level: 2}}, z: 0}}\n");
  const Eigen::Matrix3d Q{{4, 1, 0}, {1, 2, 0.5}, {0, 0.5, 1}};
  const Eigen::Vector3d center(1, 2, 3);
  constexpr int kRuns = 20000;
  std::vector<double> shares;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    const Eigen::Vector3d d = part(*setup, start(*setup, 7, run), "x") - center;
    const double level = d.dot(Q * d) / 2;
    ASSERT_LE(level, 1 + 1e-12);
    shares.push_back(std::pow(level, 1.5));  // of the volume within: uniform in [0, 1]
    mean += d / kRuns;
    covariance += d * d.transpose() / kRuns;
  }
  std::sort(shares.begin(), shares.end());
  double farthest = 0;
  for (std::size_t k = 0; k < shares.size(); ++k)
    farthest = std::max(farthest, std::abs(shares[k] - (static_cast<double>(k) + 0.5) / kRuns));
  EXPECT_LT(farthest, 1.63 / std::sqrt(kRuns));  // Kolmogorov-Smirnov, 1 %
  EXPECT_LT(mean.norm(), 0.02);
  // Of the uniform distribution in {d: d'Q d <= r} in n dimensions: r inv(Q)/(n + 2).
  const Eigen::Matrix3d expected = 2 * tests::inverse(Q) / 5;
  EXPECT_LT((covariance - expected).cwiseAbs().maxCoeff(), 0.02 * expected.norm());
}

TEST(EventDraws, BetweenTwoLevelsAnEllipsoidIsFilledEvenly) {
  const auto shares = [](const std::string& level) {
    const auto setup = setup_of(
        kPlant, "campaign: {horizon: 1, initial: {x: {ellipsoid: {matrix: Q, level: " + level +
                    "}}, z: 0}}\n");
    const Eigen::Matrix3d Q{{4, 1, 0}, {1, 2, 0.5}, {0, 0.5, 1}};
    std::vector<double> found;
    for (std::uint64_t run = 0; run < 2000; ++run) {
      const Eigen::Vector3d d = part(*setup, start(*setup, 7, run), "x");
      found.push_back(std::pow(d.dot(Q * d), 1.5));
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  const std::vector<double> hollow = shares("[1, 4]");  // shares of the volume from 1 to 8
  EXPECT_GE(hollow.front(), 1 - 1e-12);
  EXPECT_LE(hollow.back(), 8 + 1e-12);
  for (std::size_t k = 0; k < hollow.size(); ++k)
    EXPECT_NEAR((hollow[k] - 1) / 7, (static_cast<double>(k) + 0.5) / 2000, 1.63 / std::sqrt(2000));
  const std::vector<double> surface = shares("[2, 2]");
  EXPECT_NEAR(surface.front(), std::pow(2, 1.5), 1e-12);
  EXPECT_NEAR(surface.back(), std::pow(2, 1.5), 1e-12);
}

/// The first values of a noise in many runs.
std::vector<VectorXd> first_values(const claims::RunSetup& setup, const std::string& name,
                                   std::uint64_t runs) {
  std::vector<VectorXd> values;
  for (std::uint64_t run = 0; run < runs; ++run)
    values.push_back(part(setup, start(setup, 5, run), name));
  return values;
}

/// Mean and covariance of samples of a normal distribution. Those of N samples have the deviations
/// sqrt(V_ii/N) and sqrt((V_ii V_jj + V_ij^2)/N) at most sqrt(2 V_ii V_jj/N): five of them, with a
/// fixed seed.
void expect_normal(const std::vector<VectorXd>& samples, const VectorXd& mean,
                   const numbers::Matrix& V) {
  const auto many = static_cast<double>(samples.size());
  VectorXd sum = VectorXd::Zero(mean.size());
  numbers::Matrix products = numbers::Matrix::Zero(mean.size(), mean.size());
  for (const VectorXd& one : samples) {
    sum += one - mean;
    products += (one - mean) * (one - mean).transpose();
  }
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    EXPECT_LE(std::abs(sum(i) / many), 5 * std::sqrt(V(i, i) / many)) << i;
    for (Eigen::Index j = 0; j < mean.size(); ++j)
      EXPECT_LE(std::abs(products(i, j) / many - V(i, j)),
                5 * std::sqrt(2 * V(i, i) * V(j, j) / many))
          << i << ", " << j;
  }
}

constexpr std::uint64_t kMany = 20000;

TEST(EventDraws, NoiseHasItsCovariance) {
  // The second is of rank 2, and its third element is the sum of the others; units far apart.
  for (const char* V :
       {"[4, 1.9, 0; 1.9, 1, -0.1; 0, -0.1, 2]", "[1, 0.5, 1.5; 0.5, 1, 1.5; 1.5, 1.5, 3]",
        "[1e12, 5e-1, 0; 5e-1, 1e-12, 0; 0, 0, 0]"}) {
    SCOPED_TRACE(V);
    const auto setup = setup_of(
        "  noise: {w: {normal: {mean: [1, 0, 3], covariance: V}}}\n"
        "  data: {V: {shape: 3 x 3, default: \"" +
            std::string(V) +
            "\"}}\n  plant: {state: {x: {shape: 3, start: 0}}, flow: {x: w}}\n"
            "  claims: {k: {below: norm(x), bound: 1e99}}\n",
        "campaign: {horizon: 1}\n");
    const auto samples = first_values(*setup, "w", kMany);
    expect_normal(samples, Eigen::Vector3d(1, 0, 3), setup->system.constants.at("V"));
    const bool dependent = std::string(V).starts_with("[1,");
    for (const VectorXd& one : samples)
      EXPECT_TRUE(!dependent || std::abs(one(2) - 3 - (one(0) - 1 + one(1))) <= 1e-7) << one;
  }
}

TEST(EventDraws, StartsAndUncertainDataAreNormalOrLognormal) {
  const auto setup = setup_of(R"(  data: {P: 2 x 2, m: scalar, d: 2}
  plant:
    state: {x: {shape: 2}, z: {shape: 2 x 2}, s: {shape: 2}}
    flow: {x: m*d}
  claims: {k: {below: norm(x), bound: 1e99}}
)",
                              R"(data: {P: [[2, -1], [-1, 1]], m: 3, d: [1, -2]}
uncertain: {m: {normal: 0.1}, d: {lognormal: {deviation: 0.5}}}
campaign:
  horizon: 1
  initial:
    x: {normal: {mean: [1, -1], covariance: P}}
    z: {normal: {deviation: [[1, 2], [3, 0]]}}
    s: {lognormal: {median: [1, 10], covariance: P/4}}
)");
  const numbers::Matrix P{{2, -1}, {-1, 1}};
  const Eigen::Vector4d deviations(1, 3, 2, 0);
  expect_normal(first_values(*setup, "x", kMany), Eigen::Vector2d(1, -1), P);
  expect_normal(first_values(*setup, "z", kMany), Eigen::Vector4d::Zero(),
                deviations.cwiseAbs2().asDiagonal());
  expect_normal(first_values(*setup, "plant.m", kMany), VectorXd::Constant(1, 3),
                numbers::Matrix::Constant(1, 1, 0.01));
  const auto logarithms = [&](const std::string& name, const Eigen::Vector2d& median) {
    auto samples = first_values(*setup, name, kMany);
    for (VectorXd& one : samples) one = one.cwiseQuotient(median).array().log().matrix();
    return samples;
  };
  expect_normal(logarithms("s", Eigen::Vector2d(1, 10)), Eigen::Vector2d::Zero(), P / 4);
  expect_normal(logarithms("plant.d", Eigen::Vector2d(1, -2)), Eigen::Vector2d::Zero(),
                numbers::Matrix::Identity(2, 2) / 4);
}

TEST(EventDraws, AStartUsesTheFirstValueOfNoise) {
  const auto setup = setup_of(
      R"(  events: {tick: {every: 0.1}}
  noise: {w: {normal: 1, new at: tick}, u: {uniform: [2, 3]}}
  data: {c: {shape: scalar, default: 4}}
  plant: {state: {x: {shape: 2, start: "[w; u*c]"}, y: {shape: scalar, start: x(1)}}, flow: {x: "[0; u]"}}
  claims: {k: {below: norm(x), bound: 1e99}}
)",
      "uncertain: {c: {normal: 1}}\ncampaign: {horizon: 1, initial: {y: x(1) + 2*u}}\n");
  simulate::Simulator simulator(setup->system, setup->scenario);
  for (std::uint64_t run = 0; run < 5; ++run) {
    const hybrid::Trajectory made = simulator.run(3, run);
    const auto at = [&](const std::string& name) { return part(*setup, made.start, name); };
    EXPECT_EQ(at("x")(0), at("w")(0));
    EXPECT_EQ(at("x")(1), at("u")(0) * at("plant.c")(0));
    EXPECT_EQ(at("y")(0), at("x")(0) + 2 * at("u")(0));
  }
}

TEST(EventDraws, ABadSpreadIsRefusedAtItsPlace) {
  for (const auto& [spread, message] :
       {std::pair("{normal: {covariance: \"[1, 2, 0; 2, 1, 0; 0, 0, 1]\"}}",
                  "positive semidefinite"),
        std::pair("{normal: {covariance: \"[0, 1e-3, 0; 1e-3, 1e9, 0; 0, 0, 1]\"}}",
                  "positive semidefinite"),
        std::pair("{normal: {covariance: \"[1, 0.5, 0; 0, 1, 0; 0, 0, 1]\"}}", "symmetric"),
        std::pair("{lognormal: {covariance: -Q}}", "positive semidefinite"),
        std::pair("{normal: {covariance: eye(2)}}", "no covariance of a column"),
        std::pair("{normal: [1, -2, 3]}", "negative"), std::pair("{normal: [1, 2]}", "3 x 1"),
        std::pair("{normal: {mean: [1, 2], deviation: 1}}", "3 x 1")}) {
    SCOPED_TRACE(spread);
    try {
      setup_of(kPlant, "campaign: {horizon: 1, initial: {z: 0, x: " + std::string(spread) + "}}\n");
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("p.yaml:"), std::string::npos) << error.what();
    }
  }
}

TEST(EventDraws, StatesOfAllComponentsTakeListsBoxesAndEllipsoids) {
  const auto setup =
      setup_of(kPlant,
               "campaign: {horizon: 1, initial: {x: {list: [[1, 2, 3], [4, 5, 6]]}, a.z: {box: "
               "[2, 3]}, b.z: {ellipsoid: {matrix: 4*I}}}}\n");
  for (std::uint64_t run = 0; run < 20; ++run) {
    const VectorXd values = start(*setup, 3, run);
    EXPECT_EQ(part(*setup, values, "x")(0), run % 2 == 0 ? 1 : 4);
    EXPECT_GE(part(*setup, values, "a.z").minCoeff(), 2);
    EXPECT_LE(part(*setup, values, "a.z").maxCoeff(), 3);
    EXPECT_LE(part(*setup, values, "b.z").norm(), 0.5 * (1 + 1e-12));
    EXPECT_EQ(values, start(*setup, 3, run)) << "a run replays";
  }
  EXPECT_NE(part(*setup, start(*setup, 3, 0), "b.z"), part(*setup, start(*setup, 4, 0), "b.z"));
}

TEST(EventDraws, ABadEllipsoidIsRefused) {
  for (const auto& [ellipsoid, message] :
       {std::pair("{matrix: -Q}", "positive definite"),
        std::pair("{matrix: \"[1, 1, 0; 0, 1, 0; 0, 0, 1]\"}", "not symmetric"),
        std::pair("{matrix: Q, level: -1}", "level"),
        std::pair("{matrix: Q, level: [2, 1]}", "expected [low, high]"),
        std::pair("{matrix: Q, level: [1, 2, 3]}", "a number, or two of them"),
        std::pair("{matrix: eye(2)}", "wrong shape")}) {
    SCOPED_TRACE(ellipsoid);
    try {
      setup_of(kPlant, "campaign: {horizon: 1, initial: {z: 0, x: {ellipsoid: " +
                           std::string(ellipsoid) + "}}}\n");
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("p.yaml:"), std::string::npos) << error.what();
    }
  }
}

/// Every combination once in as many runs as there are.
TEST(EventDraws, VerticesTakeEachCombinationInTurn) {
  const std::string data =
      "data: {A: [[1, 2], [3, 4]], As: [[[1, 0], [0, 1]], [[2, 0], [0, 2]], [[3, 0], [0, 3]]]}\n";
  const std::string method =
      "  data: {A: 2 x 2, c: {shape: scalar, default: 5}, As: {shape: 2 x 2, for: i in 1..3}}\n"
      "  plant: {state: {x: {shape: 2, start: \"[1; 1]\"}}, flow: {x: c*A*x}}\n"
      "  claims: {k: {below: norm(x), bound: 1e9}}\n";
  for (const char* uncertain :
       {"uncertain: {A: {vertices: As}, c: {box: [1, 2], sampling: vertices}}\n",
        "uncertain: {A: {vertices: [As(1), 2*As(1), [[3, 0], [0, 3]]]}, c: {vertices: [1, "
        "2]}}\n"}) {
    SCOPED_TRACE(uncertain);
    const auto setup = setup_of(method, data + uncertain + "campaign: {horizon: 1}\n");
    std::set<std::pair<double, double>> seen;
    for (std::uint64_t run = 0; run < 12; ++run) {
      VectorXd values = start(*setup, 1, run);
      hybrid::NoiseDraws noise(setup->system, setup->scenario, 1, run);
      for (std::size_t k = 0; k < setup->system.noise.size(); ++k) noise.draw(k, values);
      const VectorXd A = part(*setup, values, "plant.A");
      const double c = part(*setup, values, "plant.c")(0);
      EXPECT_EQ(A(0), 1 + static_cast<double>(run % 3));
      EXPECT_EQ(A(1), 0);
      EXPECT_EQ(c, 1 + static_cast<double>(run / 3 % 2));
      seen.insert({A(0), c});
    }
    EXPECT_EQ(seen.size(), 6U);
  }
}

TEST(EventDraws, CornersOfABoxOfAMatrix) {
  const std::string method =
      "  data: {A: 2 x 2}\n"
      "  plant: {state: {x: {shape: 2, start: \"[1; 1]\"}}, flow: {x: A*x}}\n"
      "  claims: {k: {below: norm(x), bound: 1e9}}\n";
  const auto setup =
      setup_of(method,
               "data: {A: [[1, 2], [3, 4]]}\n"
               "uncertain: {A: {box: [\"[0, 2; 1, 3]\", \"[1, 2; 5, 4]\"], sampling: vertices}}\n"
               "campaign: {horizon: 1}\n");
  ASSERT_EQ(setup->system.noise[0].values.size(), 8U);
  std::set<std::vector<double>> seen;
  for (const numbers::Matrix& corner : setup->system.noise[0].values) {
    EXPECT_EQ(corner(0, 1), 2);
    EXPECT_TRUE(corner(0, 0) == 0 || corner(0, 0) == 1);
    EXPECT_TRUE(corner(1, 0) == 1 || corner(1, 0) == 5);
    EXPECT_TRUE(corner(1, 1) == 3 || corner(1, 1) == 4);
    seen.insert({corner.data(), corner.data() + 4});
  }
  EXPECT_EQ(seen.size(), 8U);
}

TEST(EventDraws, ASinusoidIsWhatItSays) {
  // x' = w: x(T) = (a/f)(cos(p) - cos(f T + p)).
  const std::string method =
      "  noise: {w: {sinusoid: {amplitude: \"[2; 3]\", frequency: [1, 4], phase: [0, 2*pi]}}}\n"
      "  plant: {state: {x: {shape: 2, start: 0}}, flow: {x: w}}\n"
      "  claims: {k: {below: norm(x), bound: 1e9}}\n";
  const auto setup = setup_of(method, "campaign: {horizon: 3}\n");
  simulate::Simulator simulator(setup->system, setup->scenario);
  std::set<double> frequencies;
  for (std::uint64_t run = 0; run < 5; ++run) {
    const hybrid::Trajectory made = simulator.run(11, run, {1e-11, 1e-11});
    ASSERT_EQ(made.ending, hybrid::Ending::horizon);
    const VectorXd end = std::get<hybrid::FlowPiece>(made.parts.back()).end;
    const double f = part(*setup, end, "w.frequency")(0);
    const double p = part(*setup, end, "w.phase")(0);
    EXPECT_TRUE(1 <= f && f < 4 && 0 <= p && p < 6.2832);
    frequencies.insert(f);
    EXPECT_EQ(made.parts.size(), 1U) << "a sinusoid is no switch";
    const double integral = (std::cos(p) - std::cos(f * 3 + p)) / f;
    EXPECT_NEAR(part(*setup, end, "x")(0), 2 * integral, 1e-8);
    EXPECT_NEAR(part(*setup, end, "x")(1), 3 * integral, 1e-8);
  }
  EXPECT_EQ(frequencies.size(), 5U);
}

TEST(EventDraws, LostJumpsAreCounted) {
  const std::string method =
      R"(  events: {sample: {every: 0.1, lost: {probability: 0.5, in_a_row: 2}}}
  plant: {state: {x: {shape: scalar, start: 1}, n: {shape: scalar, start: 0}}, output: {y: x}, flow: {x: -x}, at: {sample: {n: n + 1}}}
  observer: {state: {k: {shape: scalar, start: 0}}, at: {sample: {k: k + 1}}}
)";
  const auto instance = instance_of(method, R"(campaign: {horizon: 5.05, runs: 1}
compare: [{count: sample}, {lost: sample}, {at: {t: 5.02}, value: n}, {at: {t: 5.02}, value: k}]
)");
  const auto setup = claims::make_run_setup(bind::run_texts(instance, {}));
  const auto found = statistics::survey_figures(*setup, instance.design->compare, 1, {1}).figures;
  ASSERT_EQ(found.size(), 4U);
  const auto value = [&](std::size_t k) { return found[k].least->value; };
  EXPECT_EQ(value(0), 50);
  EXPECT_EQ(value(2), 50);
  EXPECT_GT(value(1), 10);
  EXPECT_LT(value(1), 40);
  EXPECT_EQ(value(1) + value(3), 50) << "what is lost no observer saw";
}

}  // namespace
}  // namespace gainsmith::verify
