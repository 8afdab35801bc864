#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "packs/lane_lengths.h"
#include "verify/campaign.h"
#include "verify/linear_cases.h"
#include "verify/pack_judge.h"

namespace gainsmith::verify::linear_packs {
namespace {

using claims::Judgement;
using linear::LinearSystem;
using linear::Wide;

struct Made {
  std::unique_ptr<const Setup> setup;
  Packs packs;
};

Made make(const std::string& text) {
  const model::Instance instance = bind::bind(io::read_problem(text));
  Made made{make_setup(instance, {}), {}};
  made.packs = make_packs(*made.setup, 1000);
  return made;
}

class LinearPacks : public testing::TestWithParam<Case> {};

TEST_P(LinearPacks, AgreeWithCarefulRuns) {
  const Made made = make(GetParam().text);
  ASSERT_NE(made.packs.linear, nullptr);
  constexpr std::uint64_t runs = 80;
  const std::vector<packs::PackVerdict> verdicts =
      packs::LinearRunner(*made.packs.linear).run(7, 0, runs);
  Judge judge(*made.setup);
  std::size_t open = 0, held = 0, violated = 0;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const packs::PackVerdict& pack = verdicts[run];
    open += pack.open ? 1 : 0;
    if (pack.open) continue;
    const RunVerdict careful = judge(7, run);
    EXPECT_EQ(pack.happened, careful.happened);
    for (std::size_t c = 0; c < pack.findings.size(); ++c) {
      const claims::Finding& finding = careful.findings[c];
      ++(pack.findings[c].violated() ? violated : held);
      EXPECT_EQ(pack.findings[c].violated(), finding.violated())
          << "run " << run << ", claim " << c << ": " << finding.value << " and " << finding.bound;
      EXPECT_NEAR(pack.findings[c].score, finding.score, 1e-6 * (1 + std::abs(finding.score)))
          << "run " << run << ", claim " << c;
    }
  }
  EXPECT_GT(held, 0U);
  EXPECT_GT(violated, 0U);
  EXPECT_LE(open, runs / 20);
}

TEST_P(LinearPacks, AreTheSameInAnyOrder) {
  const Made made = make(GetParam().text);
  packs::LinearRunner runner(*made.packs.linear);
  const std::vector<packs::PackVerdict> all = runner.run(3, 0, 150);
  const std::vector<packs::PackVerdict> some = runner.run(3, 37, 115);
  for (std::size_t k = 0; k < some.size(); ++k) {
    EXPECT_EQ(some[k].open, all[37 + k].open);
    for (std::size_t c = 0; c < some[k].findings.size(); ++c)
      EXPECT_EQ(some[k].findings[c].score, all[37 + k].findings[c].score);
  }
}

/// What code over lanes says of one flow after the other beside 100 digits.
class Beside {
 public:
  explicit Beside(const LinearSystem& system)
      : system_(system),
        flow_(system.model.A, {}, system.model.longest()),
        first_(*system.first),
        step_(*system.step),
        gather_(*system.gather) {}

  /// The largest part of a bound that an error takes over some flows.
  double largest_part(unsigned flows) {
    const linear::LinearModel& model = system_.model;
    const auto m = static_cast<Eigen::Index>(model.drawn.size());
    Wide xi = Wide::Ones(m + (model.constant ? 1 : 0), 1);
    first_.input(0)[0] = length(0, model.first_low, model.first_high);
    for (Eigen::Index k = 0; k < m; ++k) {
      const double value = std::sin(1.0 + 2 * static_cast<double>(k));
      xi(k) = Decimal100(value);
      first_.input(1 + static_cast<std::size_t>(k))[0] = value;
    }
    if (system_.first_table.has_pieces())
      system_.first_table.values(first_.input(0)[0], first_.input(1 + model.drawn.size()),
                                 lanes::kLanes);
    first_.run();
    Wide z = *model.D(Decimal100(first_.input(0)[0]), true) *
             flow_(Decimal100(first_.input(0)[0])).E * model.S * xi;
    for (std::size_t k = 0; k < system_.carried; ++k)
      step_.input(1 + k)[0] = first_.result(0, k)[0];
    double most = part(z, 0);
    for (unsigned k = 1; k <= flows; ++k) {
      if ((k - 1) % static_cast<unsigned>(system_.flows_of_block) == 0) gather();
      step_.input(0)[0] = length(k, model.low, model.high);
      step_.run();
      z = Wide(*model.D(Decimal100(step_.input(0)[0]), false) *
               flow_(Decimal100(step_.input(0)[0])).E * model.B * z);
      most = std::max(most, part(z, root_));
    }
    return most;
  }

 private:
  static double length(unsigned k, double low, double high) {
    const double turns = 0.6180339887498949 * (k + 1);
    return low + (high - low) * (turns - std::floor(turns));
  }
  void gather() {
    ++gathered_;
    root_ = std::sqrt(gathered_);
    gather_.input(0)[0] = 1;
    gather_.input(1)[0] = root_;
    for (std::size_t k = 0; k < system_.carried; ++k)
      gather_.input(2 + k)[0] = step_.input(1 + k)[0];
    gather_.run();
    for (std::size_t k = 0; k < system_.carried; ++k)
      step_.input(1 + k)[0] = gather_.result(0, k)[0];
  }
  double part(const Wide& z, double root) {
    double most = 0;
    for (std::size_t i = 0; i < system_.rank; ++i) {
      double row = 0;
      for (std::size_t j = 0; j < system_.rank; ++j)
        row += std::pow(step_.input(1 + system_.G(i, j))[0], 2);
      const double bound = root * std::sqrt(row) + step_.input(1 + system_.b(i))[0];
      const Decimal100 error =
          z(static_cast<Eigen::Index>(i)) - Decimal100(step_.input(1 + system_.z(i))[0]);
      most = std::max(most, std::abs(static_cast<double>(error)) / bound);
      if (z(static_cast<Eigen::Index>(i)) != 0)
        worst_ = std::max(worst_, bound / static_cast<double>(Decimal100(z.cwiseAbs().maxCoeff())));
    }
    return most;
  }

 public:
  double worst_ = 0;  ///< the largest bound as a part of z

 private:
  const LinearSystem& system_;
  linear::WideFlow flow_;
  lanes::LaneMachine first_, step_, gather_;
  double gathered_ = 0, root_ = 0;
};

TEST_P(LinearPacks, NoErrorIsBeyondItsBound) {
  const Made made = make(GetParam().text);
  Beside beside(*made.packs.linear);
  const double part = beside.largest_part(100);
  EXPECT_LE(part, 1);
  EXPECT_LT(beside.worst_, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Systems, LinearPacks, testing::ValuesIn(linear_cases()));

/// A coefficient of a table that is wrong by 1e-11 is seen.
TEST(LinearFaults, AWrongCoefficientIsFoundByBounds) {
  const Made made = make(linear_cases()[0].text);
  linear::LinearModel wrong = made.packs.linear->model;
  wrong.A(0, 1) += Decimal100(1e-11);
  auto system = linear::make_linear_system(wrong);
  ASSERT_NE(system, nullptr);
  const_cast<LinearSystem&>(*system).model.A(0, 1) -= Decimal100(1e-11);
  EXPECT_GT(Beside(*system).largest_part(20), 1);
}

TEST(LinearPacks, LengthsAreThoseOfOneRunAfterTheOther) {
  for (const Case& one : linear_cases()) {
    const Made made = make(one.text);
    const hybrid::System& system = made.setup->events->system;
    const hybrid::Scenario& scenario = made.setup->events->scenario;
    const std::size_t laws = std::max<std::size_t>(scenario.laws.front().size(), 1);
    for (std::uint64_t law = 0; law < laws; ++law) {
      packs::LaneRuns runs{};
      for (std::size_t l = 0; l < runs.size(); ++l) runs[l] = law + l * laws + (1ULL << 33U) * laws;
      packs::LaneLengths lanes(system, scenario);
      lanes.begin(5, runs);
      std::vector<hybrid::EventClocks> clocks;
      for (const std::uint64_t run : runs) clocks.emplace_back(system, scenario, 5, run);
      for (int k = 0; k < 40; ++k) {
        for (std::size_t l = 0; l < runs.size(); ++l) {
          ASSERT_EQ(lanes.length()[l], clocks[l].length(0)) << one.name << ", flow " << k;
          ASSERT_EQ(lanes.due()[l], clocks[l].due(0)) << one.name << ", flow " << k;
          clocks[l].advance(0, clocks[l].due(0));
        }
        lanes.advance();
      }
    }
  }
}

/// Values that fall over hundreds of decades are followed.
TEST(LinearPacks, FollowADecayOverHundredsOfDecades) {
  const Made made = make(with(with(linear_cases()[0].text, "[0.6, 0.5; -0.9, 0.75]*x", "0.2*x"),
                              "horizon: 3", "horizon: 200"));
  ASSERT_NE(made.packs.linear, nullptr);
  const auto verdicts = packs::LinearRunner(*made.packs.linear).run(1, 0, 64);
  EXPECT_TRUE(std::none_of(verdicts.begin(), verdicts.end(),
                           [](const auto& one) { return one.open || one.violated(); }));
}

/// Most of what a flow may make larger is in other directions.
TEST(LinearPacks, FollowWhatFallsWhereFlowsMayGrow) {
  const Made made = make(R"yaml(problem: p
method:
  method: m
  let: {A: "[0.2, -1.01; 1, 0]", C: "[0.5, -1]"}
  plant:
    state: {z: {shape: 2}}
    output: {y: C*z}
    flow: {z: A*z}
  observer:
    state: {zh: {shape: 2, start: 0}, s: {shape: 1, start: 0}}
    flow: {zh: A*zh, s: 1}
    jump: {zh: "zh + ([-2.4619; -2.2310] + [1.5430; 0.7715]*s)*(y - C*zh)", s: 0}
  timer: {tau: {reset: [0.5, 2.9]}}
  claims: {error: {shrinks: norm(z - zh), to: 0.2}}
campaign: {runs: 160, horizon: 200, initial: {z: {box: [-2, 3]}}}
)yaml");
  ASSERT_NE(made.packs.linear, nullptr);
  EXPECT_LT(made.packs.linear->flows_of_block, 8);
  EXPECT_LT(Beside(*made.packs.linear).largest_part(100), 1);
  const auto verdicts = packs::LinearRunner(*made.packs.linear).run(1, 0, 64);
  EXPECT_TRUE(
      std::none_of(verdicts.begin(), verdicts.end(), [](const auto& one) { return one.open; }));
}

/// A part of the jump that is 0 at the lengths at which its range is found is not lost.
TEST(LinearPacks, DoNotRunAJumpWhoseRangeIsLargerElsewhere) {
  const auto is_linear = [](const std::string& factor) {
    return make(R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}, s: {shape: 1, start: 0}}
    flow: {x: "[-0.1, 1; -1, -0.1]*x", s: 1}
    jump: {x: "[x(1); )yaml" +
                factor +
                R"yaml(*x(1)]", s: 0}
  timer: {tau: {reset: [0, 1]}}
  claims: {error: {shrinks: norm(x), to: 0.2}}
campaign: {runs: 160, horizon: 8, initial: {x: {box: [-2, 3]}}}
)yaml")
               .packs.linear != nullptr;
  };
  EXPECT_TRUE(is_linear("s"));
  EXPECT_FALSE(is_linear("s*(s - 0.25)*(s - 0.5)*(s - 0.75)*(s - 1)*20"));
}

TEST(LinearPacks, RunWhatTheyCan) {
  const auto is_linear = [](const std::string& from, const std::string& to) {
    return make(with(linear_cases()[0].text, from, to)).packs.linear != nullptr;
  };
  EXPECT_TRUE(is_linear("reset: [0.1, 0.6]", "reset: [0, 0.6]"));
  // A value that rises along flows, one that is no form, a cost that may fall, fast turns; a fast decay is
  // none of them.
  EXPECT_FALSE(is_linear("nonincreasing: \"x'*x\"", "nonincreasing: \"x(1)^2 + 5*x(2)^2\""));
  EXPECT_FALSE(is_linear("nonincreasing: \"x'*x\"", "nonincreasing: abs(x(1))"));
  EXPECT_FALSE(is_linear("flow: \"x'*x\"", "flow: \"x(1)^2 - x(2)^2\""));
  EXPECT_FALSE(is_linear("[-0.1, 1; -1, -0.1]", "[-0.1, 400; -400, -0.1]"));
  EXPECT_TRUE(is_linear("[-0.1, 1; -1, -0.1]", "[-0.1, 1; -1, -400]"));
  // Peaks in few coordinates.
  const auto has_peaks = [](const std::string& states) {
    return make("problem: p\nmethod:\n  method: m\n  plant:\n    state: {x: " + states +
                "}\n    flow: {x: -x}\n    jump: {x: 0.5*x}\n  timer: {tau: {reset: [0.1, 0.6]}}\n"
                "  claims: {a: {below: norm(x), bound: 10}}\n"
                "campaign: {runs: 100, horizon: 6, initial: {x: {box: [-1, 1]}}}\n")
               .packs.linear != nullptr;
  };
  EXPECT_TRUE(has_peaks("12"));
  EXPECT_FALSE(has_peaks("13"));
}

/// Bounds far above, near and below what runs reach; of a form and of a norm.
TEST(LinearPacks, KnowPeaksOrLeaveThemOpen) {
  std::size_t decided = 0, held = 0, violated = 0;
  for (const std::string claim : {"below: \"x'*x\"", "below: norm(x)"})
    for (const std::string bound : {"40", "4", "2.5", "1.5", "0.01", "-1"}) {
      const Made made = make(
          "problem: p\nmethod:\n  method: m\n  plant:\n    state: {x: 2}\n"
          "    flow: {x: \"[0.1, 1; -1.5, -0.3]*x\"}\n"
          "    jump: {x: \"[0.6, 0.5; -0.9, 0.75]*x\"}\n"
          "  timer: {tau: {reset: [0.1, 0.6]}}\n  claims: {a: {" +
          claim + ", bound: " + bound +
          "}}\ncampaign: {runs: 100, horizon: 6, initial: {x: {box: [-1, 1]}}}\n");
      ASSERT_NE(made.packs.linear, nullptr);
      ASSERT_NE(made.packs.any, nullptr);
      EXPECT_GT(made.packs.linear->model.claims[0].growth, 1);
      const auto verdicts = packs::LinearRunner(*made.packs.linear).run(7, 0, 64);
      Judge judge(*made.setup);
      for (std::uint64_t run = 0; run < verdicts.size(); ++run) {
        if (verdicts[run].open) continue;
        ++decided;
        const claims::Finding& pack = verdicts[run].findings[0];
        const claims::Finding careful = judge(7, run).findings[0];
        ++(pack.violated() ? violated : held);
        EXPECT_EQ(pack.violated(), careful.violated()) << claim << " " << bound << ", run " << run;
        EXPECT_LE(std::abs(pack.value - careful.value), pack.rounding + 1e-6)
            << claim << " " << bound << ", run " << run;
      }
    }
  EXPECT_GT(decided, 200U);
  EXPECT_GT(held, 64U);
  EXPECT_GT(violated, 64U);
}

/// A careful run ends where a state leaves 1e150, and its claims with it.
TEST(LinearPacks, LeaveARunThatDivergesToTheCarefulOne) {
  const Made made = make(R"yaml(problem: p
method:
  method: m
  plant: {state: {a: 1, b: 1}, flow: {a: -0.1*a, b: 0.5*b}}
  timer: {tau: {reset: [0.5, 1]}}
  claims: {a: {shrinks: norm(a), to: 0.5}, b: {shrinks: norm(b), to: 1}}
campaign: {runs: 100, horizon: 698}
)yaml");
  ASSERT_NE(made.packs.linear, nullptr);
  const auto verdicts = packs::LinearRunner(*made.packs.linear).run(1, 0, 64);
  EXPECT_TRUE(
      std::all_of(verdicts.begin(), verdicts.end(), [](const auto& one) { return one.open; }));
}

/// As a search for the worst run asks for them.
TEST(LinearPacks, RunsWhoseDrawsAreGivenAreThoseOfTheCarefulRun) {
  std::vector<hybrid::GivenRun> given(3);
  for (std::size_t k = 0; k < given.size(); ++k) {
    const double size = 1.0 + static_cast<double>(k);
    given[k].starts = {numbers::Matrix(Eigen::Vector2d(size, -0.5))};
    given[k].first = {0.1 * size};
    given[k].lengths = {{0.6, 0.1 * size}};
  }
  const model::Instance instance = bind::bind(io::read_problem(linear_cases()[0].text));
  const auto setup = make_setup(instance, {}, &given);
  const auto linear = make_linear_packs(*setup);
  ASSERT_NE(linear, nullptr);
  Judge judge(*setup);
  packs::LinearRunner runner(*linear);
  const auto together = runner.run(1, 0, 3);
  for (std::uint64_t run = 0; run < 3; ++run) {
    const packs::PackVerdict alone = runner.run(1, run, run + 1).front();
    const RunVerdict careful = judge(1, run);
    ASSERT_FALSE(alone.open);
    for (std::size_t c = 0; c < alone.findings.size(); ++c) {
      EXPECT_EQ(alone.findings[c].score, together[run].findings[c].score);
      EXPECT_NEAR(alone.findings[c].score, careful.findings[c].score, 1e-6);
      EXPECT_EQ(alone.findings[c].violated(), careful.findings[c].violated());
    }
  }
}

/// Runs 0, 1024 and 4096, and none between.
TEST(LinearPacks, AreRepeatedLessOftenTheMoreRunsThereAre) {
  const model::Instance instance = bind::bind(io::read_problem(linear_cases()[0].text));
  CampaignOptions options;
  options.threads = 1;
  options.runs = 5000;
  const Report report = run_campaign(*make_setup(instance, {}), options);
  std::uint64_t open = 0;
  for (const std::uint64_t count : report.open) open += count;
  EXPECT_LE(*report.careful, open + 3);
  EXPECT_GE(*report.careful, 1U);
}

Report campaign_of(const std::string& text, unsigned threads) {
  const model::Instance instance = bind::bind(io::read_problem(text));
  CampaignOptions options;
  options.threads = threads;
  options.runs = 3000;
  return run_campaign(*make_setup(instance, {}), options);
}

/// No law by default has intervals that shrink to nothing.
TEST(LinearPacks, RunsWithIntervalsFromZeroReachTheirHorizon) {
  const std::string text = with(linear_cases()[0].text, "reset: [0.1, 0.6]", "reset: [0, 0.6]");
  EXPECT_EQ(campaign_of(text, 1).unfinished, 0U);
}

TEST(LinearPacks, ThreadsDoNotMatter) {
  const Report one = campaign_of(linear_cases()[0].text, 1);
  const Report two = campaign_of(linear_cases()[0].text, 2);
  EXPECT_EQ(one.violations, two.violations);
  EXPECT_EQ(one.worst_run, two.worst_run);
  for (std::size_t k = 0; k < one.checks.size(); ++k) {
    EXPECT_EQ(one.checks[k].worst.score, two.checks[k].worst.score);
    EXPECT_EQ(one.checks[k].worst_run, two.checks[k].worst_run);
  }
}

}  // namespace
}  // namespace gainsmith::verify::linear_packs
