#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "base/stop.h"
#include "bind/bind.h"
#include "bind/stated.h"
#include "io/problem_text.h"
#include "statistics/consistency.h"
#include "statistics/exact_sum.h"
#include "statistics/figure_survey.h"
#include "statistics/quantiles.h"
#include "statistics/value_sketch.h"
#include "support/stop.h"

namespace gainsmith::statistics::figures_over_runs {
namespace {

double binomial_below(std::uint64_t k, std::uint64_t n, double p) {
  double sum = 0;
  for (std::uint64_t i = 0; i < k; ++i) {
    const auto a = static_cast<double>(i), b = static_cast<double>(n);
    sum += std::exp(std::lgamma(b + 1) - std::lgamma(a + 1) - std::lgamma(b - a + 1) +
                    a * std::log(p) + (b - a) * std::log1p(-p));
  }
  return sum;
}

TEST(Quantiles, RanksCoverAndAreTheTightest) {
  for (const std::uint64_t n : {20U, 100U, 999U})
    for (const double p : {0.05, 0.5, 0.95})
      for (const double confidence : {0.9, 0.99}) {
        const RankInterval ranks = rank_interval(n, p, confidence);
        const double each = (1 - confidence) / 2, rounding = 1e-10;
        EXPECT_LE(binomial_below(ranks.lower, n, p), each + rounding);
        EXPECT_GT(binomial_below(ranks.lower + 1, n, p), each - rounding);
        EXPECT_LE(1 - binomial_below(ranks.upper, n, p), each + rounding);
        EXPECT_GT(1 - binomial_below(ranks.upper - 1, n, p), each - rounding);
      }
}

TEST(Quantiles, IntervalsHoldTheQuantileAsOftenAsTheySay) {
  std::mt19937_64 random(1);
  std::exponential_distribution<double> drawn(1);
  constexpr int kSamples = 2000;
  int held = 0;
  for (int k = 0; k < kSamples; ++k) {
    std::vector<double> values(60);
    for (double& value : values) value = drawn(random);
    ValueSketch sketch;
    sketch.add(values);
    const Quantile median = quantile_of(sketch, 0.5, 0.9);
    if (*median.low <= std::log(2.0) && std::log(2.0) <= *median.high) ++held;
  }
  EXPECT_GE(held, kSamples * 0.88);
}

TEST(Quantiles, FewRunsHaveNoEnds) {
  ValueSketch sketch;
  sketch.add({1, 2, 3});
  const Quantile found = quantile_of(sketch, 0.5, 0.95);
  EXPECT_EQ(found.value, 2);
  EXPECT_FALSE(found.low || found.high);
}

/// Wherever the values that are not known lie, the interval of all of them lies in what is said.
TEST(Quantiles, HoldWhereverUnknownValuesLie) {
  std::vector<double> known(60);
  for (std::size_t k = 0; k < known.size(); ++k) known[k] = static_cast<double>(k);
  ValueSketch sketch;
  sketch.add(known);
  for (const double p : {0.05, 0.5, 0.95})
    for (const std::uint64_t unknown : {0U, 1U, 5U, 40U}) {
      const Quantile found = quantile_of(sketch, p, 0.9, unknown);
      for (const double where : {-1.0, 29.5, 61.0}) {
        ValueSketch all;
        all.add(known);
        all.add(std::vector<double>(unknown, where));
        const Quantile of_all = quantile_of(all, p, 0.9);
        EXPECT_TRUE(!found.low || *found.low <= of_all.low.value());
        EXPECT_TRUE(!found.high || *found.high >= of_all.high.value());
        EXPECT_TRUE(unknown > 0 || found.low == of_all.low);
      }
    }
}

TEST(ValueSketch, EnclosesRanksAndDoesNotDependOnOrder) {
  std::mt19937_64 random(2);
  std::lognormal_distribution<double> drawn(0, 2);
  std::vector<double> values(5000);
  for (double& value : values) value = drawn(random);
  ValueSketch whole(64), parts(64);
  whole.add(values);
  for (std::size_t k = values.size(); k > 0; k -= 100) {
    ValueSketch part(64);
    part.add({values.begin() + static_cast<std::ptrdiff_t>(k - 100),
              values.begin() + static_cast<std::ptrdiff_t>(k)});
    parts.add(part);
  }
  EXPECT_EQ(whole, parts);
  EXPECT_LE(whole.parts().size(), 64U);
  EXPECT_FALSE(whole.exact());
  std::sort(values.begin(), values.end());
  for (std::size_t rank = 1; rank <= values.size(); rank += 77) {
    const Enclosure found = whole.ranked(rank);
    const double value = values[rank - 1];
    EXPECT_LE(found.low, value);
    EXPECT_GE(found.high, value);
    EXPECT_LE(std::abs(found.middle() - value), whole.resolution() * value * (1 + 1e-12));
  }
}

TEST(ExactSum, ForgetsNothing) {
  ExactSum sum, other;
  for (const double value : {1e300, 1.0, -1e300, 5e-324, -0.25}) sum.add(value);
  for (const double value : {-0.25, 5e-324, -1e300, 1.0, 1e300}) other.add(value);
  EXPECT_EQ(sum, other);
  EXPECT_EQ(sum.value(), 0.75);
  sum.add(-2);
  EXPECT_EQ(sum.value(), -1.25);
}

TEST(Consistency, TellsFalsifiedCovariances) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> drawn;
  const auto fit_of = [&](double covariance) {
    SquaredErrors errors{2};
    for (int k = 0; k < 500; ++k) {
      const double a = drawn(random), b = drawn(random);
      errors.sum.add((a * a + b * b) / covariance);
      ++errors.count;
    }
    return consistency_of(errors, 0.999).fit;
  };
  EXPECT_EQ(fit_of(1), Fit::consistent);
  EXPECT_EQ(fit_of(0.5), Fit::too_optimistic);
  EXPECT_EQ(fit_of(2), Fit::too_pessimistic);
}

TEST(Consistency, IsUndecidedWhereASquareIsNone) {
  SquaredErrors errors{1};
  claims::Squares run;
  for (const double square : {1.0, 0.5, 2.0}) run.add(square);
  errors.add(run);
  EXPECT_EQ(consistency_of(errors, 0.95).fit, Fit::consistent);
  for (const double square :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    claims::Squares other;
    other.add(square);
    SquaredErrors more = errors;
    more.add(other);
    EXPECT_EQ(more.improper, 1U);
    EXPECT_EQ(more.count, 3U);
    EXPECT_EQ(consistency_of(more, 0.95).fit, Fit::undecided);
    EXPECT_EQ(consistency_of(more, 0.95).mean, 3.5 / 3);
  }
  EXPECT_FALSE(consistency_of(SquaredErrors{1}, 0.95).mean);
}

TEST(ValueSketch, HoldsNegativeAndInfiniteNumbers) {
  const double infinity = std::numeric_limits<double>::infinity();
  ValueSketch sketch(4);
  sketch.add({-infinity, -3, -2.5, -1, -0.0, 0, 1e-320, 2, 7, infinity});
  EXPECT_EQ(sketch.count(), 10U);
  EXPECT_EQ(sketch.ranked(1).low, -infinity);
  EXPECT_EQ(sketch.ranked(10).high, infinity);
  EXPECT_LE(sketch.ranked(3).low, -2.5);
  EXPECT_GE(sketch.ranked(3).high, -2.5);
  EXPECT_GE(sketch.ranked(9).high, 7);
  const ValueSketch before = sketch;
  sketch.add(ValueSketch(4));
  EXPECT_EQ(sketch, before);
}

/// Noise, an event and a figure of each kind of number: whole, infinite, none, squares.
const std::string kRandom = R"(problem: p
method:
  method: m
  events: {sample: {every: [0.1, 0.4], lost: 0.3}}
  noise:  {w: {normal: 0.1, new at: sample}}
  plant:
    state: {x: {shape: 1}}
    flow:  {x: -x}
    at:    {sample: {x: x + w}}
  claims: {c: {below: norm(x), bound: 9}}
campaign: {runs: 200, horizon: 1, initial: {x: {box: [[-1], [1]]}}}
compare:
  - {peak: x}
  - {settles: norm(x), below: 0.2}
  - {lost: sample}
  - {at: {event: sample, count: 5}, value: x}
  - {nees: x, covariance: "[x + 0.5]", at: {t: 0.5}}
)";

TEST(FigureSurvey, OfPartsIsThatOfTheWhole) {
  const model::Instance instance = bind::bind(io::read_problem(kRandom));
  const auto setup = claims::make_run_setup(bind::run_texts(instance, {}));
  const auto survey = [&](std::uint64_t first, std::uint64_t last, unsigned threads) {
    RunNumbers runs{last - first, {}};
    for (std::uint64_t run = first; run < last; ++run) runs.listed.push_back(run);
    return survey_figures(*setup, instance.design->compare, 3, runs, threads);
  };
  const FigureSurvey whole = survey_figures(*setup, instance.design->compare, 3, {200}, 2);
  FigureSurvey a = survey(0, 71, 1), b = survey(71, 75, 1), c = survey(75, 200, 2);
  FigureSurvey left = a, right = b, back = c;
  left.add(b);
  left.add(c);
  right.add(c);
  FigureSurvey nested = a;
  nested.add(right);
  back.add(b);
  back.add(a);
  EXPECT_EQ(left, whole);
  EXPECT_EQ(nested, whole);
  EXPECT_EQ(back, whole);
  EXPECT_EQ(whole.runs, 200U);
  for (const FigureSummary& figure : whole.figures)
    EXPECT_EQ(figure.values.count() + figure.without, 200U) << figure.title;
  EXPECT_GT(whole.figures[3].without, 0U) << "not all runs have five samples";
  EXPECT_GT(whole.figures[4].squares.improper, 0U);
}

/// Wherever a stop comes, amid a run or its figures: what is told is that of the runs before it.
TEST(FigureSurvey, OfAStopIsThatOfTheRunsBeforeIt) {
  const model::Instance instance = bind::bind(io::read_problem(R"(problem: p
method:
  method: m
  plant: {state: {x: {shape: 3}}, flow: {x: "[x(2); x(3); -x(1) - x(2) - x(3)]"}}
  claims: {c: {below: norm(x), bound: 99}}
campaign: {runs: 200, horizon: 1, initial: {x: {box: [[-1, -1, -1], [1, 1, 1]]}}}
compare: [{nees: x, covariance: "(1 + x(1)^2)*I + x*x'", at: {t: 0.5}}, {rms: norm(x), over: [0, 1]}]
)"));
  const auto setup = claims::make_run_setup(bind::run_texts(instance, {}));
  const auto survey = [&](std::uint64_t runs) {
    return survey_figures(*setup, instance.design->compare, 3, {runs}, 1);
  };
  std::mt19937_64 random(1);
  int amid = 0;
  for (int k = 0; k < 100; ++k) {
    FigureSurvey stopped;
    {
      const tests::StopInTest stop;
      const std::chrono::microseconds wait(random() % 20000);
      const std::jthread impatient([&] {
        std::this_thread::sleep_for(wait);
        request_stop();
      });
      stopped = survey(200);
    }
    if (stopped.runs > 0 && stopped.runs < 200) ++amid;
    EXPECT_EQ(stopped, survey(stopped.runs));
  }
  EXPECT_GT(amid, 10);
}

/// In every second run y is chaotic: its figures are known up to some time, or not at all.
TEST(FigureSurvey, CountsRunsThatAreNotKnown) {
  const model::Instance instance = bind::bind(io::read_problem(R"(problem: p
method:
  method: m
  events: {tick: {every: 1}}
  plant:
    state: {y: {shape: scalar, start: 0.3}, k: {shape: scalar, start: 0}}
    at: {tick: {y: k*y*(1 - y)}}
campaign: {runs: 4, horizon: 90, initial: {k: {list: [2, 4]}}}
compare: [{at: {t: 90}, value: y}, {at: {t: 10}, value: y}, {count: tick}, {peak: y}]
)"));
  const auto setup = claims::make_run_setup(bind::run_texts(instance, {}));
  const FigureSurvey found = survey_figures(*setup, instance.design->compare, 1, {4});
  for (const std::size_t chaotic : {0U, 3U}) {
    const FigureSummary& figure = found.figures[chaotic];
    EXPECT_EQ(figure.unknown.count, 2U) << figure.title;
    EXPECT_EQ(figure.unknown.first, 1U);
    EXPECT_NE(figure.unknown.why.find("size of y"), std::string::npos) << figure.unknown.why;
    EXPECT_EQ(figure.values.count(), 2U);
    EXPECT_EQ(figure.without, 0U);
  }
  EXPECT_NEAR(found.figures[0].least->value, 0.5, 1e-12) << "y goes to 1 - 1/k";
  for (const std::size_t known : {1U, 2U}) EXPECT_EQ(found.figures[known].unknown.count, 0U);
  EXPECT_EQ(found.figures[2].error, 0) << "a count";
  // Errors double at each tick.
  EXPECT_GT(found.figures[1].largest->error + found.figures[1].least->error, 1e-15);
  EXPECT_LT(found.figures[1].error, 1e-10);
}

}  // namespace
}  // namespace gainsmith::statistics::figures_over_runs
