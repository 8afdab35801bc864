#include "forall/between.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "forall/forms.h"
#include "forall/variables.h"
#include "support/input_error.h"

namespace gainsmith::forall {
namespace {

using numbers::Matrix;
using Status = DomainBound::Status;
using testing::Form;
using testing::interval;
using testing::number;

/// Puts the matrix together from the monomials of its intervals and the values of the others.
using Fill = std::function<void(const Point& fixed, Form& form)>;

DomainBound bound(const Fill& fill, const Domain& domain, double slack = 0) {
  const Expand expand = [&](const Point& fixed, MonomialTable& monomials) {
    Form form(monomials.variables());
    fill(fixed, form);
    monomials = form.monomials;
    return std::optional(Expansion(form.terms.begin(), form.terms.end()));
  };
  return bound_on_domain(expand, domain, slack);
}

/// constant + factor cos(w t) in the first variable.
Fill wave(double constant, double factor, double w) {
  return [=](const Point&, Form& form) {
    form.add({}, number(constant));
    form.add({form.monomials.index(0, {0, 0, w, false})}, number(factor));
  };
}

TEST(BetweenTest, WhatHoldsIsBoundedAndWhatFailsIsFound) {
  const Domain domain = {interval("tau", 0, 1)};
  for (const double k : {1.0, 24.0, 48.0, 96.0, 144.0}) {
    const double w = 2 * std::numbers::pi * k;
    // The smallest value of 1.01 + cos is 0.01, at every half period.
    EXPECT_EQ(bound(wave(1.01, 1, w), domain).status, Status::holds) << k;
    const DomainBound failed = bound(wave(0.99, 1, w), domain);
    EXPECT_EQ(failed.status, Status::violated) << k;
    for (const Minimum& point : failed.violations) {
      const double tau = point.point.values.at("tau")(0, 0);
      EXPECT_NEAR(point.value, 0.99 + std::cos(w * tau), 1e-9);
      EXPECT_LE(point.value, 0);
    }
  }
}

/// S (expm(A tau) + expm(A tau)' + c I) S with random units S: far above 0 for c = 98, below it for
/// c = -100.
TEST(BetweenTest, RandomUnits) {
  std::mt19937 generator(31);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 2 + trial % 3;
    const Matrix A = Matrix::NullaryExpr(n, n, [&] { return normal(generator); });
    Matrix S = Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) S(i, i) = std::pow(10.0, 3 * normal(generator));
    const auto status = [&](double c) {
      const Fill fill = [&](const Point&, Form& form) {
        for (const auto& [index, R] : form.exponential(A, 0))
          form.add({index}, S * (R + R.transpose()) * S);
        form.add({}, c * S * S);
      };
      return bound(fill, {interval("tau", -0.3, 0.8)}).status;
    };
    EXPECT_EQ(status(98), Status::holds);
    EXPECT_EQ(status(-100), Status::violated);
  }
}

/// c + cos(40 t) cos(30 s) + 0.1 t + 0.1 s: the minimum is c - 0.99215, near (pi/40, 0).
TEST(BetweenTest, BoxesOfSeveralVariables) {
  const auto with = [](double c) {
    const Fill fill = [c](const Point&, Form& form) {
      MonomialTable& table = form.monomials;
      form.add({}, number(c));
      form.add({table.index(0, {0, 0, 40, false}), table.index(1, {0, 0, 30, false})}, number(1));
      for (const int v : {0, 1}) form.add({table.index(v, {1, 0, 0, false})}, number(0.1));
    };
    return bound(fill, {interval("t", 0, 1), interval("s", 0, 1)});
  };
  EXPECT_EQ(with(0.9925).status, Status::holds);
  const DomainBound failed = with(0.9915);
  ASSERT_EQ(failed.status, Status::violated);
  EXPECT_LE(failed.violations.front().value, 0);
}

/// c + M tau.
TEST(BetweenTest, SetsAndPolytopesAreTakenElementByElement) {
  const Domain domain = {interval("tau", 0, 1), testing::polytope("M", {number(1), number(-3)})};
  const auto with = [&](double c) {
    const Fill fill = [c](const Point& fixed, Form& form) {
      form.add({}, number(c));
      form.add({form.monomials.index(0, {1, 0, 0, false})}, fixed.values.at("M"));
    };
    return bound(fill, domain);
  };
  const DomainBound failed = with(2);
  ASSERT_EQ(failed.status, Status::violated);
  EXPECT_EQ(failed.violations.front().point.values.at("M")(0, 0), -3);
  EXPECT_EQ(with(3.1).status, Status::holds);
}

/// What touches 0 is bounded with a slack alone.
TEST(BetweenTest, SlackLetsAnInequalityTouchZero) {
  const Domain domain = {interval("tau", 0, 7)};
  EXPECT_NE(bound(wave(1, -1, 1), domain).status, Status::holds);
  EXPECT_EQ(bound(wave(1, -1, 1), domain, 1e-6).status, Status::holds);
}

TEST(BetweenTest, SaysWhatItCannotDecide) {
  const Domain domain = {interval("tau", 0, 1)};
  const Expand none = [](const Point&, MonomialTable&) { return std::nullopt; };
  EXPECT_EQ(bound_on_domain(none, domain, 0).status, Status::unknown);
  const DomainBound open = bound(wave(1.0001, 1, 1e7), domain);
  EXPECT_TRUE(open.status == Status::open) << static_cast<int>(open.status);
  EXPECT_EQ(open.where.rfind("tau in [", 0), 0U) << open.where;
}

}  // namespace
}  // namespace gainsmith::forall
