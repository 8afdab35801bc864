// A design is bound once: other values need no binding, unless they change a degree or a rank.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "bind/instance.h"
#include "bind/small_problem.h"
#include "bind/stated.h"
#include "expr/text/work.h"
#include "model/stated.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;

/// R has two columns where T1 > 1, otherwise one; U is diag([1, 2^-k]) for T1 near 2^k; X has the
/// degree 1 up to rate = 2, else 3.
const std::string kMethod = changed(
    changed(changed(kSmallMethod, "  M: {",
                    "  R: {shape: n x r, default: \"orth(diag([1; max(T1 - 1, 0)]))\"}\n"
                    "  U: {shape: n x n, default: \"units([0, T1; 0, 0], [1, 0])\"}\n  M: {"),
            "X: n x m", "X: {shape: n x m, of: tau, degree: \"where(rate > 2, 3, 1)\"}, Z: r x m"),
    "gains: {K: b'*P, A: A}", "gains: {K: b'*P, A: A, G(t): inv(P)*X(t)}");

/// The error of an action, as text; empty when there is none.
template <class Action>
std::string refusal(Action action) {
  try {
    action();
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

model::Overrides random_overrides(std::mt19937& random) {
  constexpr double kChoices[] = {-1, 0, 0.25, 0.5, 1, 1.5, 2, 3, 4.25};
  model::Overrides overrides;
  for (const char* name : {"T1", "T2", "delta", "rate"})
    if (random() % 2 == 0) overrides[name] = kChoices[random() % std::size(kChoices)];
  return overrides;
}

std::vector<int> shapes_of(const model::Design& design) {
  std::vector<int> numbers;
  for (const model::Design::Rank& rank : design.ranks) numbers.push_back(rank.rank);
  for (const model::Design::Units& units : design.units)
    numbers.insert(numbers.end(), units.exponents.begin(), units.exponents.end());
  for (const model::Design::Unknown& unknown : design.unknowns) {
    numbers.push_back(unknown.degree);
    numbers.push_back(unknown.shape.rows);
  }
  return numbers;
}

TEST(Evaluation, IsWhatBindingWouldGive) {
  // Values that the campaign as written does not fit are for bind() alone to refuse.
  const std::string text = kSmallProblem.substr(0, kSmallProblem.find("campaign:"));
  const Small small(text, kMethod);
  std::mt19937 random(1);
  model::DesignPtr design = small.instance.design;
  int same = 0;
  int changed_shapes = 0;
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const model::Overrides overrides = random_overrides(random);
    const std::string error = refusal([&] { bind(small.problem, overrides); });
    ASSERT_EQ(refusal([&] { evaluate(design, overrides); }), error);
    if (!error.empty()) {
      ++refused;
      continue;
    }
    const model::Instance expected = bind(small.problem, overrides);
    const model::Instance found = evaluate(design, overrides);
    EXPECT_EQ(found.values, expected.values);
    EXPECT_EQ(found.overrides, overrides);
    EXPECT_EQ(shapes_of(*found.design), shapes_of(*expected.design));
    const bool keeps_shapes = shapes_of(*expected.design) == shapes_of(*design);
    EXPECT_EQ(found.design == design, keeps_shapes);
    keeps_shapes ? ++same : ++changed_shapes;
    // What follows must hold from any design of the problem.
    design = found.design;
  }
  EXPECT_GT(same, 50);
  EXPECT_GT(changed_shapes, 50);
  EXPECT_GT(refused, 50);
}

TEST(Evaluation, WithoutOverridesGoesBackToTheProblem) {
  const Small small(kSmallProblem, kMethod);
  const model::Instance other = bind(small.problem, {{"rate", 3}});
  EXPECT_EQ(polynomials(*other.design).at(0).size(), 4U);
  const model::Instance back = evaluate(other.design);
  EXPECT_EQ(polynomials(*back.design).at(0).size(), 2U);
  EXPECT_EQ(back.values, small.instance.values);
}

TEST(Evaluation, UnitsFollowTheirArguments) {
  const Small small(kSmallProblem, kMethod);
  EXPECT_EQ(small.instance.values.at("U"), (numbers::Matrix{{1, 0}, {0, 2}}));
  EXPECT_EQ(evaluate(small.instance.design, {{"T1", 4.25}}).values.at("U"),
            (numbers::Matrix{{1, 0}, {0, 0.25}}));
}

TEST(Evaluation, GainsOfOutputsFollowTheirPlant) {
  const Small small(kSmallProblem,
                    changed(kMethod, "  M: {",
                            "  F0: {shape: scalar, default: \"output_gain([0, T1; 1, "
                            "0], [0; 1], [1, 1])\"}\n  M: {"));
  const auto is_stable = [](const model::Instance& instance, double T1) {
    const double F = instance.values.at("F0")(0, 0);  // s^2 - F s - T1 (1 + F)
    return F < 0 && T1 * (1 + F) < 0;
  };
  EXPECT_TRUE(is_stable(small.instance, 0.5));
  const model::Instance other = evaluate(small.instance.design, {{"T1", 4.25}});
  EXPECT_TRUE(is_stable(other, 4.25));
  EXPECT_EQ(other.values, bind(small.problem, {{"T1", 4.25}}).values);
}

/// Data may read parameters that are numbers, and parameters data.
TEST(Evaluation, NumbersAmongTheParametersComeBeforeTheData) {
  const Small small(
      kSmallProblem,
      changed(changed(kMethod, "  M: {", "  S: {shape: scalar, default: 2*first}\n  M: {"),
              "parameters: {", "parameters: {last: S + 1, first: 3, "));
  EXPECT_EQ(small.instance.values.at("S")(0, 0), 6);
  EXPECT_EQ(small.instance.values.at("last")(0, 0), 7);
  EXPECT_EQ(small.instance.design->parameters.front().name, "last");
  const model::Instance other = evaluate(small.instance.design, {{"first", 5}});
  EXPECT_EQ(other.values.at("last")(0, 0), 11);
}

/// The programs of another rank may fail where those of this one do not.
TEST(Evaluation, AChangedRankIsSeenBeforeWhatFollowsFromIt) {
  const std::string method = changed(
      kMethod, "  M: {", "  S: {shape: r x r, default: \"inv(R'*diag([1; T1 - 1])*R)\"}\n  M: {");
  const Small small(changed(kSmallProblem, "T1: 0.5", "T1: 2"), method);
  ASSERT_EQ(small.instance.values.at("S").rows(), 2);
  const model::Overrides overrides = {{"T1", 1}};
  const model::Instance found = evaluate(small.instance.design, overrides);
  EXPECT_EQ(found.values.at("S").rows(), 1);
  EXPECT_NE(found.design, small.instance.design);
}

TEST(Evaluation, ANegativeToleranceIsRefused) {
  const std::string method = changed(
      kSmallMethod, "  M: {", "  R: {shape: n x r, default: \"orth(eye(n), delta0)\"}\n  M: {");
  const Small small(changed(kSmallProblem, "  T1:", "  delta0: 0.1\n  T1:"),
                    changed(method, "  A: n x n\n", "  A: n x n\n  delta0: scalar\n"));
  const model::Overrides negative = {{"delta0", -0.1}};
  const std::string error = refusal([&] { evaluate(small.instance.design, negative); });
  EXPECT_NE(error.find("the tolerance must not be negative"), std::string::npos) << error;
  EXPECT_EQ(error, refusal([&] { bind(small.problem, negative); }));
}

/// What stands at the end of its range needs a range.
TEST(Evaluation, ARangeIsCheckedForTheScalarThatStandsAtItsEnd) {
  const std::string text =
      changed(changed(kSmallProblem, "campaign:", "search: {largest: {T2: [T1, 1]}}\ncampaign:"),
              "constant: T1", "constant: T1");
  const Small small(text,
                    changed(kSmallMethod, "T2: {shape: scalar, default: 2*T1}", "T2: scalar"));
  EXPECT_EQ(small.instance.values.at("T2")(0, 0), 0.5);
  const model::Overrides beyond = {{"T1", 2}};
  const std::string error = refusal([&] { evaluate(small.instance.design, beyond); });
  EXPECT_NE(error.find("T2: expected a range [low, high] with low < high"), std::string::npos)
      << error;
  EXPECT_EQ(error, refusal([&] { bind(small.problem, beyond); }));
  EXPECT_EQ(evaluate(small.instance.design, {{"T1", 2}, {"T2", 3}}).values.at("T2")(0, 0), 3);
}

/// Ranges and the campaign are checked for the values of the problem. So a scan over T1 is not
/// refused where it changes a rank.
TEST(Evaluation, RangesAndTheCampaignAreThoseOfTheProblem) {
  const std::string text =
      changed(changed(kSmallProblem, "campaign:", "negotiable: {T1: [T1, 1]}\ncampaign:"),
              "{constant: T1}", "{constant: 0.75}");
  const Small small(text, kMethod);
  for (const double T1 : {0.8, 2.0}) {
    const model::Overrides overrides = {{"T1", T1}};
    EXPECT_NO_THROW(evaluate(small.instance.design, overrides)) << T1;
    EXPECT_THROW(bind(small.problem, overrides), InputError) << T1;
  }
}

TEST(Evaluation, OfAChangedDesignKeepsTheChange) {
  const Small small;
  const model::Instance without = with_design(small.instance, [](model::Design& design) {
    design.inequalities.clear();
    design.objective.reset();
  });
  EXPECT_EQ(small.design().inequalities.size(), 1U);
  EXPECT_TRUE(without.design->inequalities.empty());
  const model::Instance later = evaluate(without.design, {{"T1", 0.25}});
  EXPECT_EQ(later.design, without.design);
  EXPECT_EQ(later.values.at("T2")(0, 0), 0.5);
}

model::Gains some_gains() {
  model::Gains gains;
  gains.gains = {{"K", numbers::Matrix{{9, 8}}}};
  gains.gain_functions = {{"G", "t", model::GainFunction::Kind::formula, "inv(P)*X(t)", {}}};
  gains.unknowns = {{"P", 2 * numbers::Matrix::Identity(2, 2)},
                    {"X_0", numbers::Matrix{{1}, {2}}},
                    {"X_1", numbers::Matrix{{5}, {-7}}}};
  gains.functions = {{"X(tau)", "X_0 + X_1*tau", {}}};
  return gains;
}

TEST(Evaluation, ParsesAndBindsNothing) {
  const Small small(kSmallProblem, kMethod);
  model::Gains weighted = some_gains();
  model::Function function = polynomials(small.design()).at(0);
  function.basis.texts = {"", "sin(tau)"};
  weighted.functions = {{"X(tau)", function.text(), function.body().program}};

  const expr::Work before = expr::work_done();
  const model::Instance other = evaluate(small.instance.design, {{"T1", 0.55}, {"delta", 2}});
  EXPECT_EQ(other.design, small.instance.design);
  const model::Instance changed =
      with_design(other, [](model::Design& design) { design.objective.reset(); });
  for (const model::Gains& gains : {some_gains(), weighted}) {
    const model::Stated stated = state(changed, gains);
    EXPECT_TRUE(stated.value(changed.design->claims[2].factor->program));
  }
  EXPECT_EQ(expr::work_done(), before);

  evaluate(small.instance.design, {{"rate", 3}});
  EXPECT_GT(expr::work_done().bound, before.bound) << "another degree needs other programs";
  EXPECT_EQ(expr::work_done().parsed, before.parsed) << "a text is parsed once";
}

TEST(Evaluation, BindingParsesNothing) {
  const model::Problem problem = small_problem(kSmallProblem, kMethod);
  const expr::Work before = expr::work_done();
  bind(problem);
  EXPECT_EQ(expr::work_done().parsed, before.parsed);
}

}  // namespace
}  // namespace gainsmith::bind
