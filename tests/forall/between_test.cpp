#include "forall/between.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lmi/variables.h"

namespace gainsmith::forall {
namespace {

using Status = DomainProof::Status;
using testing::interval;
using testing::number;

DomainProof prove(const std::string& text, const Domain& domain, const numbers::Values& known = {},
                  double slack = 0) {
  return prove_on_domain(testing::program(text, domain, known), domain, known, slack);
}

TEST(ProveTest, WhatHoldsIsProvedAndWhatFailsIsFound) {
  for (const double k : {1.0, 24.0, 48.0, 96.0, 144.0}) {
    const numbers::Values w = {{"w", number(2 * std::numbers::pi * k)}};
    // The smallest value of 1.01 + cos is 0.01, at every half period.
    EXPECT_EQ(prove("1.01 + cos(w*tau)", {interval("tau", 0, 1)}, w).status, Status::proved) << k;
    const DomainProof failed = prove("0.99 + cos(w*tau)", {interval("tau", 0, 1)}, w);
    EXPECT_EQ(failed.status, Status::violated) << k;
    for (const Minimum& point : failed.violations) {
      const double tau = point.point.values.at("tau")(0, 0);
      EXPECT_NEAR(point.value, 0.99 + std::cos(2 * std::numbers::pi * k * tau), 1e-9);
      EXPECT_LE(point.value, 0);
    }
  }
}

/// Positive definite with a margin by construction: B(tau) = E' E + margin I, in random units.
TEST(ProveTest, RandomGramians) {
  std::mt19937 generator(31);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 2 + trial % 3;
    const numbers::Matrix A = numbers::Matrix::NullaryExpr(n, n, [&] { return normal(generator); });
    numbers::Matrix S = numbers::Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) S(i, i) = std::pow(10.0, 3 * normal(generator));
    const numbers::Values known = {{"A", A}, {"S", S}};
    const Domain domain = {interval("tau", -0.3, 0.8)};
    EXPECT_EQ(prove("S*(expm(A*tau) + expm(A*tau)' - 2*eye(" + std::to_string(n) + "))*S + 100*S*S",
                    domain, known)
                  .status,
              Status::proved);
    EXPECT_EQ(prove("S*(expm(A*tau) + expm(A*tau)' - 100*eye(" + std::to_string(n) + "))*S", domain,
                    known)
                  .status,
              Status::violated);
  }
}

TEST(ProveTest, BoxesOfSeveralVariables) {
  const Domain box = {interval("t", 0, 1), interval("s", 0, 1)};
  const std::string wave = "cos(40*t)*cos(30*s) + 0.1*t + 0.1*s";
  // The minimum is -0.99215, near (pi/40, 0).
  EXPECT_EQ(prove("0.9925 + " + wave, box).status, Status::proved);
  const DomainProof failed = prove("0.9915 + " + wave, box);
  ASSERT_EQ(failed.status, Status::violated);
  EXPECT_LE(failed.violations.front().value, 0);
}

TEST(ProveTest, SetsAndPolytopesAreTakenElementByElement) {
  const Domain domain = {interval("tau", 0, 1), testing::polytope("M", {number(1), number(-3)})};
  const DomainProof failed = prove("2 + M*tau", domain);
  ASSERT_EQ(failed.status, Status::violated);
  EXPECT_EQ(failed.violations.front().point.values.at("M")(0, 0), -3);
  EXPECT_EQ(prove("3.1 + M*tau", domain).status, Status::proved);
}

/// What touches 0 is proved with a slack alone.
TEST(ProveTest, SlackLetsAnInequalityTouchZero) {
  const Domain domain = {interval("tau", 0, 7)};
  EXPECT_NE(prove("1 - cos(tau)", domain).status, Status::proved);
  EXPECT_EQ(prove("1 - cos(tau)", domain, {}, 1e-6).status, Status::proved);
}

TEST(ProveTest, SaysWhatItCannotDecide) {
  EXPECT_EQ(prove("sqrt(tau) + 1", {interval("tau", 1, 2)}).status, Status::unknown);
  const DomainProof open = prove("1.0001 + cos(1e7*tau)", {interval("tau", 0, 1)});
  EXPECT_TRUE(open.status == Status::open) << static_cast<int>(open.status);
  EXPECT_EQ(open.where.rfind("tau in [", 0), 0U) << open.where;
}

}  // namespace
}  // namespace gainsmith::forall
