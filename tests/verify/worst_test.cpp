// The search for the worst run: its draws, its lengths, its margins, and what it finds.
#include "verify/worst.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <unsupported/Eigen/KroneckerProduct>

#include "bind/bind.h"
#include "bind/stated.h"
#include "io/problem_text.h"
#include "support/linear_algebra.h"
#include "verify/campaign.h"
#include "verify/draw_cube.h"
#include "verify/judge.h"

namespace gainsmith::verify::worst {
namespace {

using Eigen::MatrixXd;

model::Instance instance_of(const std::string& method, const std::string& problem) {
  return bind::bind(io::read_problem("problem: p\nmethod:\n  method: m\n" + method + problem));
}

/// problems/own-systems/uneven-samples.yaml.
model::Instance uneven_samples(const std::string& horizon = "40") {
  return instance_of(
      R"(  let: {A: "[0, 1; -1, 0]", C: "[1, 0]", L: "[0.6; 2]"}
  events: {sample: {every: [0.1, 1.1]}}
  plant: {state: {x: 2}, output: {y: C*x}, flow: {x: A*x}}
  observer:
    state: {xh: {shape: 2, start: 0}}
    flow: {xh: A*xh}
    at: {sample: {xh: xh + L*(y - C*xh)}}
  signals: {e: x - xh}
  claims: {bounded: {below: norm(e), bound: 1000}, small: {below: norm(e), bound: 1e12}}
)",
      "campaign: {horizon: " + horizon + ", sampling: uniform, initial: {x: {box: [-1, 1]}}}\n");
}

/// From one sample to the next, a length s between.
MatrixXd step_of(double s) {
  MatrixXd J(2, 2), R(2, 2);
  J << 0.4, 0, -2, 1;
  R << std::cos(s), std::sin(s), -std::sin(s), std::cos(s);
  return J * R;
}

WorstOptions options_of(std::uint64_t runs, unsigned threads = 1) {
  WorstOptions options;
  options.runs = runs;
  options.threads = threads;
  return options;
}

/// A plant in which everything is drawn.
const std::string kDrawn =
    R"(  data: {c: {shape: scalar, default: 1}}
  events: {sample: {every: [0.5, 1], first: [0, 0.25], lost: 0.5}}
  noise: {w: {normal: 2, new at: sample}, v: {uniform: [-1, 3]}}
  plant: {state: {x: {shape: 2}, z: {shape: 2}}, flow: {x: v*x - c*x, z: 0*z}, at: {sample: {x: x + w}}}
  claims: {b: {below: norm(x), bound: 1e9}}
)";
const std::string kCampaign =
    "campaign: {horizon: 4, initial: {x: {box: [0, 1/3]}, z: {ellipsoid: {center: [1, 2], matrix: "
    "\"[1, 0; 0, 4]\", level: 1}}}}\nuncertain: {c: {vertices: [2, 5]}}\n";

class Drawn {
 public:
  Drawn()
      : instance_(instance_of(kDrawn, kCampaign)),
        setup_(claims::make_run_setup(bind::run_texts(instance_, {}))) {}

  DrawCube cube(std::size_t period) const { return {setup_->system, setup_->scenario, period}; }
  std::size_t noise(const std::string& name) const {
    const auto& all = setup_->system.dynamics.noise;
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; }) -
        all.begin());
  }
  std::size_t slot(const std::string& name) const { return setup_->system.slot(name).value(); }
  const claims::RunSetup& setup() const { return *setup_; }

 private:
  model::Instance instance_;
  std::unique_ptr<const claims::RunSetup> setup_;
};

TEST(DrawCube, EndsOfTheCubeAreThoseOfTheRanges) {
  const Drawn drawn;
  const DrawCube cube = drawn.cube(1);
  const hybrid::GivenRun low = cube.at(std::vector<double>(cube.size(), 0));
  const hybrid::GivenRun high = cube.at(std::vector<double>(cube.size(), 1));
  EXPECT_EQ(low.first[0], 0.0);
  EXPECT_EQ(high.first[0], 0.25);
  EXPECT_EQ(low.lengths[0], std::vector<double>{0.5});
  EXPECT_EQ(high.lengths[0], std::vector<double>{1.0});
  EXPECT_EQ(low.losses[0], std::vector<char>{0});
  EXPECT_EQ(high.losses[0], std::vector<char>{1});
  const std::size_t x = drawn.slot("x");
  EXPECT_EQ(high.starts[x]->maxCoeff(), 1.0 / 3);
  EXPECT_EQ(low.starts[x]->maxCoeff(), 0);
  const std::size_t v = drawn.noise("v"), c = drawn.noise("plant.c");
  EXPECT_EQ(low.noise[v][0](0), -1);
  EXPECT_EQ(high.noise[v][0](0), 3);
  EXPECT_EQ(low.noise[c][0](0), 2);
  EXPECT_EQ(high.noise[c][0](0), 5);
  hybrid::check_given(low, drawn.setup().system, drawn.setup().scenario);
  hybrid::check_given(high, drawn.setup().system, drawn.setup().scenario);
}

TEST(DrawCube, NormalNoiseReachesThreeDeviations) {
  const Drawn drawn;
  const DrawCube cube = drawn.cube(1);
  const std::size_t w = drawn.noise("w");
  EXPECT_EQ(cube.at(std::vector<double>(cube.size(), 1)).noise[w][0](0), 6);
  EXPECT_EQ(cube.at(std::vector<double>(cube.size(), 0)).noise[w][0](0), -6);
}

/// Around a center: three deviations of each of the independent parts.
TEST(DrawCube, CentersHaveThreeDeviationsAroundThem) {
  const auto instance =
      instance_of(R"(  data: {c: {shape: scalar, default: 1}}
  noise: {w: {normal: {mean: [0, 1], covariance: "[1, 2; 2, 4]"}}}
  plant: {state: {x: {shape: 2}}, flow: {x: w - c*x}}
  claims: {b: {below: norm(x), bound: 1e9}}
)",
                  "uncertain: {c: {lognormal: 0.5}}\ncampaign: {horizon: 4, initial: "
                  "{x: {normal: {mean: [5, 6], deviation: [0, 2]}}}}\n");
  const auto setup = claims::make_run_setup(bind::run_texts(instance, {}));
  const DrawCube cube(setup->system, setup->scenario, 1);
  ASSERT_EQ(cube.size(), 3U) << "what does not vary has no coordinate";
  const hybrid::GivenRun low = cube.at({0, 0, 0}), high = cube.at({1, 1, 1});
  const std::size_t x = setup->system.slot("x").value();
  EXPECT_EQ(*low.starts[x], (MatrixXd{{5}, {0}}));
  EXPECT_EQ(*high.starts[x], (MatrixXd{{5}, {12}}));
  const auto noise = [&](const hybrid::GivenRun& run, const std::string& name) {
    const auto& all = setup->system.dynamics.noise;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k].name == name) return run.noise[k].at(0);
    return MatrixXd();
  };
  EXPECT_EQ(noise(low, "w"), (MatrixXd{{-3}, {-5}}));
  EXPECT_EQ(noise(high, "w"), (MatrixXd{{3}, {7}}));
  EXPECT_NEAR(noise(low, "plant.c")(0), std::exp(-1.5), 1e-15);
  EXPECT_NEAR(noise(high, "plant.c")(0), std::exp(1.5), 1e-14);
}

TEST(DrawCube, StartsFillTheEllipsoid) {
  const Drawn drawn;
  const DrawCube cube = drawn.cube(1);
  double farthest = 0;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      std::vector<double> u(cube.size(), 0.5);
      // Starts come first: two of x, two of z.
      u[2] = i / 10.0, u[3] = j / 10.0;
      const MatrixXd z = *cube.at(u).starts[drawn.slot("z")] - Eigen::Vector2d(1, 2);
      const double level = z(0) * z(0) + 4 * z(1) * z(1);
      EXPECT_LE(level, 1 + 1e-12);
      farthest = std::max(farthest, level);
    }
  EXPECT_NEAR(farthest, 1, 1e-12);
}

TEST(DrawCube, ListsRepeatAfterAPeriodOrAtTheirMost) {
  const Drawn drawn;
  const auto lengths = [&](const DrawCube& cube) {
    std::vector<double> u;  // no part of it repeats
    for (std::size_t i = 0; i < cube.size(); ++i)
      u.push_back(std::fmod(0.618 * static_cast<double>(i), 1));
    return cube.at(u).lengths[0].size();
  };
  EXPECT_EQ(lengths(drawn.cube(3)), 3U);
  EXPECT_EQ(lengths(drawn.cube(0)), 7U);  // 4/0.75, and one
  const model::Instance longer =
      instance_of(kDrawn, "campaign: {horizon: 1000, initial: {x: 0, z: 0}}\n");
  const auto setup = claims::make_run_setup(bind::run_texts(longer, {}));
  EXPECT_EQ(lengths({setup->system, setup->scenario, 0}), 64U);
}

TEST(DrawCube, AListThatRepeatsItselfIsGivenOnce) {
  const Drawn drawn;
  const DrawCube two = drawn.cube(2), all = drawn.cube(0);
  const std::vector<double> u = two.with_lengths(two.start(), 0, {0.5, 1});
  EXPECT_EQ(two.at(u).lengths[0], (std::vector<double>{0.5, 1}));
  const hybrid::GivenRun run = all.at(all.unrolled(two, u));
  EXPECT_EQ(run.lengths[0], (std::vector<double>{0.5, 1, 0.5, 1, 0.5, 1, 0.5}));
  EXPECT_EQ(run.losses[0].size(), 1U);
}

TEST(DrawCube, RoundedNumbersStayInTheirRanges) {
  const Drawn drawn;
  const DrawCube cube = drawn.cube(1);
  const hybrid::GivenRun run = cube.rounded(std::vector<double>(cube.size(), 1), 2);
  EXPECT_EQ((*run.starts[drawn.slot("x")])(0), 0.33);
  const hybrid::GivenRun third = cube.rounded(std::vector<double>(cube.size(), 0.999), 1);
  EXPECT_LE((*third.starts[drawn.slot("x")])(0), 1.0 / 3);
  EXPECT_EQ(third.lengths[0][0], 1);
}

TEST(GivenRun, WhatIsNotDrawnIsRefused) {
  const Drawn drawn;
  const auto refused = [&](const auto& change) {
    hybrid::GivenRun run = drawn.cube(1).at(std::vector<double>(drawn.cube(1).size(), 0.5));
    hybrid::check_given(run, drawn.setup().system, drawn.setup().scenario);
    change(run);
    EXPECT_THROW(hybrid::check_given(run, drawn.setup().system, drawn.setup().scenario),
                 InputError);
  };
  refused([](hybrid::GivenRun& run) { run.lengths[0] = {0.4}; });
  refused([](hybrid::GivenRun& run) { run.first[0] = 0.3; });
  refused([&](hybrid::GivenRun& run) { run.starts[drawn.slot("x")] = MatrixXd::Zero(3, 1); });
  refused([&](hybrid::GivenRun& run) {
    run.noise[drawn.noise("w")] = {MatrixXd::Constant(1, 1, NAN)};
  });
}

claims::Finding finding(double value, double bound) {
  claims::Finding one;
  one.value = value;
  one.bound = bound;
  one.score = (value - bound) / std::abs(bound);
  return one;
}

TEST(Margin, RisesFromHeldToViolated) {
  using model::ClaimKind;
  EXPECT_NEAR(margin_of(finding(10, 1000), ClaimKind::below), -std::log(100), 1e-12);
  EXPECT_NEAR(margin_of(finding(1e5, 1000), ClaimKind::below), std::log(100), 1e-12);
  EXPECT_NEAR(margin_of(finding(1e5, 1000), ClaimKind::above), -std::log(100), 1e-12);
  claims::Finding negative = finding(-2, -1);
  EXPECT_EQ(margin_of(negative, ClaimKind::below), negative.score);
  claims::Finding open = finding(1, 2);
  open.sampled = false;
  EXPECT_LE(margin_of(open, ClaimKind::below), -1e6);
  EXPECT_GE(margin_of(finding(NAN, 1), ClaimKind::below), 1e6);
}

/// A violation is so rare that no campaign finds it: with the fourth moments of the error, by
/// Markov's inequality, P(|e| > 1000 at any of 400 samples) <= sum E|e_k|^4 / 1000^4.
TEST(Worst, TheBadSequenceIsRarerThanOneInAMillion) {
  constexpr int kPoints = 2001, kMostSamples = 400;
  MatrixXd fourth = MatrixXd::Zero(16, 16);
  for (int i = 0; i < kPoints; ++i) {
    const MatrixXd F = step_of(0.1 + (i + 0.5) / kPoints);
    const MatrixXd second = Eigen::kroneckerProduct(F, F);
    fourth += MatrixXd(Eigen::kroneckerProduct(second, second)) / kPoints;
  }
  double largest = 0;
  for (int angle = 0; angle < 180; ++angle) {
    const double phi = angle * M_PI / 180;
    const Eigen::Vector2d e = std::sqrt(2.0) * Eigen::Vector2d(std::cos(phi), std::sin(phi));
    const MatrixXd square = Eigen::kroneckerProduct(e, e);
    MatrixXd moment = Eigen::kroneckerProduct(square, square);
    double sum = 0;
    for (int k = 0; k < kMostSamples; ++k) {
      moment = fourth * moment;
      // |e|^4 = sum over i, j of e_i^2 e_j^2.
      sum += moment(0) + moment(3) + moment(12) + moment(15);
    }
    largest = std::max(largest, sum);
  }
  EXPECT_LT(largest / 1e12, 1e-8);
}

TEST(Worst, SamplingHoldsAndTheSearchFindsTheTurns) {
  const model::Instance instance = uneven_samples();
  CampaignOptions sampled;
  sampled.runs = 2000;
  EXPECT_EQ(run_campaign(*make_setup(instance, {}), sampled).verdict, model::CampaignVerdict::held);

  const WorstReport report = search_worst(instance, {}, options_of(600));
  EXPECT_EQ(report.verdict, model::CampaignVerdict::violated);
  ASSERT_EQ(report.claims.size(), 2U);
  EXPECT_TRUE(report.claims[0].finding.violated());
  EXPECT_FALSE(report.claims[1].finding.violated());
  std::vector<double> lengths = report.given[0].lengths[0];
  std::sort(lengths.begin(), lengths.end());
  EXPECT_EQ(lengths, (std::vector<double>{0.1, 1.1}));

  // The run that is given has the value that is reported.
  const auto setup = make_setup(instance, {}, &report.given);
  Judge judge(*setup);
  const claims::Finding again = judge(7, 0).findings[0];
  EXPECT_NEAR(again.value / report.claims[0].finding.value, 1, 1e-12);
  EXPECT_TRUE(judge.confirm(7, 0).findings[0].violated());
}

TEST(Worst, TheLengthsThatGrowFastestAreThoseOfTheProduct) {
  const auto setup = make_setup(uneven_samples(), {});
  const auto found = fastest_lengths(*setup);
  ASSERT_TRUE(found);
  const MatrixXd turn = step_of(1.1) * step_of(0.1);
  EXPECT_NEAR(found->growth, std::sqrt(tests::eigenvalues(turn).cwiseAbs().maxCoeff()), 1e-9);
  EXPECT_EQ(found->lengths.size(), 2U);
  // Every constant length is stable.
  for (double s = 0.1; s < 1.1; s += 0.01)
    EXPECT_LT(tests::eigenvalues(step_of(s)).cwiseAbs().maxCoeff(), 0.64);
}

TEST(Worst, TheReportDoesNotDependOnTheThreads) {
  const model::Instance instance = uneven_samples("20");
  const WorstReport one = search_worst(instance, {}, options_of(300, 1));
  const WorstReport two = search_worst(instance, {}, options_of(300, 2));
  EXPECT_EQ(one.runs, two.runs);
  for (std::size_t c = 0; c < one.claims.size(); ++c) {
    EXPECT_EQ(one.claims[c].finding.value, two.claims[c].finding.value);
    EXPECT_EQ(one.given[c].lengths, two.given[c].lengths);
  }
}

/// x' = (v - 1) x from [1, 2]: x(t) is largest for v = 3 and x(0) = 2.
TEST(Worst, UncertainDataAndStartsAreAtTheirWorst) {
  const model::Instance instance = instance_of(
      R"(  noise: {v: {uniform: [-1, 3]}}
  plant: {state: {x: scalar}, flow: {x: v*x - x}}
  claims: {b: {below: x, bound: 2*exp(4)*0.999}}
)",
      "campaign: {horizon: 2, initial: {x: {box: [1, 2]}}}\n");
  const WorstReport report = search_worst(instance, {}, options_of(200));
  EXPECT_EQ(report.verdict, model::CampaignVerdict::violated);
  EXPECT_NEAR(report.claims[0].finding.value, 2 * std::exp(4), 1e-4);
  EXPECT_FALSE(report.lengths);
}

/// A pendulum of which no product of matrices tells the lengths: random runs stay below 4.
TEST(Worst, TurnsAreFoundWithoutALinearPart) {
  const model::Instance instance =
      instance_of(R"~(  let: {f(x): "[x(2); -x(1) - 1e-3*x(1)^3]"}
  events: {sample: {every: [0.1, 1.1]}}
  plant: {state: {x: 2}, output: {y: x(1)}, flow: {x: f(x)}}
  observer:
    state: {xh: {shape: 2, start: 0}}
    flow: {xh: f(xh)}
    at: {sample: {xh: "xh + [0.6; 2]*(y - xh(1))"}}
  claims: {bounded: {below: norm(x - xh), bound: 20}}
)~",
                  "campaign: {horizon: 20, sampling: uniform, initial: "
                  "{x: {box: [-1, 1]}}}\n");
  CampaignOptions sampled;
  sampled.runs = 200;
  EXPECT_EQ(run_campaign(*make_setup(instance, {}), sampled).verdict, model::CampaignVerdict::held);
  const WorstReport report = search_worst(instance, {}, options_of(200));
  EXPECT_EQ(report.verdict, model::CampaignVerdict::violated);
  EXPECT_FALSE(report.lengths);
}

TEST(Worst, WithoutDrawsThereIsNothingToSearch) {
  const model::Instance instance = instance_of(
      "  plant: {state: {x: scalar}, flow: {x: -x}}\n  claims: {b: {below: x, bound: 3}}\n",
      "campaign: {horizon: 1, initial: {x: 1}}\n");
  EXPECT_THROW(search_worst(instance, {}, options_of(100)), InputError);
}

}  // namespace
}  // namespace gainsmith::verify::worst
