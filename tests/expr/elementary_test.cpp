// Elementary functions that are made of others: their digits, edges, faults and derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "expr/program/branches.h"
#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

struct Elementary {
  std::string name;
  double (*reference)(double);
  double low, high;  ///< where it is looked at
};

const std::vector<Elementary> kFunctions = {
    {"tan", [](double x) { return std::tan(x); }, -50, 50},
    {"asin", [](double x) { return std::asin(x); }, -1, 1},
    {"acos", [](double x) { return std::acos(x); }, -1, 1},
    {"atan", [](double x) { return std::atan(x); }, -50, 50},
    {"sinh", [](double x) { return std::sinh(x); }, -50, 50},
    {"cosh", [](double x) { return std::cosh(x); }, -50, 50},
    {"log10", [](double x) { return std::log10(x); }, 0.001, 1000},
    {"ceil", [](double x) { return std::ceil(x); }, -50, 50},
    {"round", [](double x) { return std::round(x); }, -50, 50},
};

/// f(x) and its relative distance from the reference in units of 2^-53.
double units_off(const Elementary& one, double x) {
  World world;
  world.set("x", x);
  const double found = world(one.name + "(x)")(0, 0);
  const double expected = one.reference(x);
  if (found == expected) return 0;
  return std::abs(found - expected) / (std::abs(expected) * 0x1p-53);
}

TEST(ElementaryFunctions, HaveTheirDigitsAtRandomPoints) {
  std::mt19937 random(1);
  for (const Elementary& one : kFunctions) {
    std::uniform_real_distribution<double> point(one.low, one.high);
    for (int k = 0; k < 300; ++k) {
      const double x = point(random);
      EXPECT_LE(units_off(one, x), 16) << one.name << " of " << x;
    }
  }
}

TEST(ElementaryFunctions, HaveTheirDigitsNearZero) {
  for (const Elementary& one : kFunctions) {
    if (one.name == "log10") continue;
    for (const double x : {1e-300, 1e-20, 1e-8, -1e-8, 1e-3, -0.1})
      EXPECT_LE(units_off(one, x), 8) << one.name << " of " << x;
  }
}

TEST(ElementaryFunctions, HaveTheirDigitsNearTheEndsOfTheirDomains) {
  for (const double off : {1e-15, 1e-12, 1e-6})
    for (const double sign : {1.0, -1.0}) {
      EXPECT_LE(units_off(kFunctions[1], sign * (1 - off)), 8) << off;
      EXPECT_LE(units_off(kFunctions[2], sign * (1 - off)), 8) << off;
    }
  World world;
  EXPECT_EQ(world("asin([1, -1])"), world("[pi/2, -pi/2]"));
  EXPECT_EQ(world("acos([1, -1])"), world("[0, pi]"));
}

TEST(ElementaryFunctions, HaveTheirDigitsFarOut) {
  for (const double x : {1e5, -1e9, 1e15}) {
    EXPECT_LE(units_off(kFunctions[0], x), 8) << x;
    EXPECT_LE(units_off(kFunctions[3], x), 4) << x;
  }
  for (const double x : {300.0, -700.0}) {
    EXPECT_LE(units_off(kFunctions[4], x), 8) << x;
    EXPECT_LE(units_off(kFunctions[5], x), 8) << x;
  }
}

TEST(ElementaryFunctions, WholeNumbersAreExact) {
  const World world;
  EXPECT_EQ(world("round([0.5, 1.5, 2.5, -0.5, -1.5, -2.5])"), (Matrix{{1, 2, 3, -1, -2, -3}}));
  EXPECT_EQ(world("ceil([2, 2.000001, -2, -2.5])"), (Matrix{{2, 3, -2, -2}}));
  World of;
  for (const double x : {0.49999999999999994, 4503599627370497.0, 9007199254740993.0, -0.0}) {
    of.set("x", x);
    EXPECT_EQ(of("round(x)")(0, 0), std::round(x)) << x;
    EXPECT_EQ(of("ceil(x)")(0, 0), std::ceil(x)) << x;
  }
}

TEST(ElementaryFunctions, WithoutAValueAreNamed) {
  const auto expect = [](const std::string& text, int column, const std::string& message) {
    const World world;
    const InputError error = input_error([&] { world(text); });
    EXPECT_NE(error.message().find(message), std::string::npos) << text << ": " << error.what();
    EXPECT_EQ(error.place().column, column) << text;
  };
  expect("1 + tan(pi/2)", 5, "tan has a pole here");
  expect("2*tan(-3*pi/2)", 3, "tan has a pole here");
  expect("1 + asin(1.5)", 5, "asin of a number outside of [-1, 1]");
  expect("acos([0, -2])", 1, "acos of a number outside of [-1, 1]");
  expect("log10(0)", 1, "log10 of a number that is not positive");
  expect("cosh(1000)", 1, "not a finite number");
  expect("tan(I)", 5, "size of the identity");
}

/// A simulation need not look for jumps of what is smooth.
TEST(ElementaryFunctions, AreSmoothWhereTheyAre) {
  World world;
  world.set("x", 0.5).set("y", 0.5);
  const auto branches = [&](const std::string& text) {
    const Program program = compile(parse({text, "test"}), world.scope);
    return branches_of(program, [](const std::string&) { return true; }).size();
  };
  for (const char* text :
       {"asin(x)", "acos(x)", "atan(x)", "tan(x)", "sinh(x)", "cosh(x)", "log10(x)"})
    EXPECT_EQ(branches(text), 0U) << text;
  EXPECT_EQ(branches("atan2(x, y)"), 1U);
  EXPECT_EQ(branches("atan2(x, -1)"), 1U);
  EXPECT_EQ(branches("ceil(x)"), 1U);
}

TEST(ElementaryFunctions, HaveTheirDerivatives) {
  const std::vector<std::pair<std::string, std::string>> slopes = {{"tan(x)", "1 + tan(x)^2"},
                                                                   {"asin(x)", "1/sqrt(1 - x^2)"},
                                                                   {"acos(x)", "-1/sqrt(1 - x^2)"},
                                                                   {"atan(x)", "1/(1 + x^2)"},
                                                                   {"sinh(x)", "cosh(x)"},
                                                                   {"cosh(x)", "sinh(x)"},
                                                                   {"log10(x)", "1/(x*log(10))"},
                                                                   {"ceil(x)", "0"},
                                                                   {"round(x)", "0"}};
  std::mt19937 random(2);
  std::uniform_real_distribution<double> point(0.01, 0.99);
  World world;
  for (int k = 0; k < 50; ++k) {
    world.set("x", point(random));
    for (const auto& [function, slope] : slopes) {
      const double expected = world(slope)(0, 0);
      EXPECT_NEAR(world("jacobian(" + function + ", x)")(0, 0), expected,
                  1e-13 * (1 + std::abs(expected)))
          << function;
    }
  }
  // Beside 0 and near 1 the derivatives keep their digits too.
  world.set("x", 1e-9);
  EXPECT_NEAR(world("jacobian(sinh(x), x)")(0, 0), 1, 1e-15);
  world.set("x", 1 - 1e-10);
  EXPECT_NEAR(world("jacobian(asin(x), x)*sqrt((1 - x)*(1 + x))")(0, 0), 1, 1e-14);
}

}  // namespace
}  // namespace gainsmith::expr
