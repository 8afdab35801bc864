// maximum(f, x in [a, b]) and minimum in texts: boxes, closed forms, what is refused, estimates.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "expr/program/estimate.h"
#include "expr/text/rename.h"
#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Extrema : public testing::Test {
 protected:
  Extrema() {
    world.set("lo", Matrix{{-8}, {-8}, {-8}}).set("hi", Matrix{{8}, {8}, {8}});
    world.set("A", Matrix{{0, 1}, {-2, -3}}).set("s", 0.6);
    world.define("duffing(x)", "[x(2); x(1) - x(1)^3]");
    world.define("largest(r)", "maximum(norm(duffing(z)), z in [-r*ones(2, 1), r*ones(2, 1)])");
  }
  double number(const std::string& text) const { return world(text)(0, 0); }
  Program compile(const std::string& text) const {
    return expr::compile(parse({text, "test"}), world.scope);
  }
  void expect_error(const std::string& text, const std::string& said) const {
    const std::string message = input_error([&] { world(text); }).message();
    EXPECT_NE(message.find(said), std::string::npos) << message;
  }
  World world;
};

TEST_F(Extrema, AreThoseOfClosedForms) {
  EXPECT_NEAR(number("maximum(norm(x), x in [lo, hi])"), 8 * std::sqrt(3), 1e-14);
  EXPECT_NEAR(number("minimum((x - 1)'*(x - 1), x in [2*eye(2)*[1; 1], [3; 4]])"), 2, 1e-14);
  EXPECT_NEAR(number("largest(2)"), std::sqrt(4 + 36), 1e-14);
  EXPECT_NEAR(number("maximum(x*exp(-x), x in [0, 5])"), std::exp(-1), 1e-15);
  EXPECT_NEAR(number("minimum(cos(x), x in [0, 3*s])"), std::cos(1.8), 1e-15);
}

TEST_F(Extrema, OfSeveralNamesAndMatrices) {
  EXPECT_NEAR(number("maximum(x*u - u^2, x in [-1, 2], u in [-3, 3])"), 1, 1e-14);
  // A rotation and a stretch: the largest |M v| over boxes of M and v.
  EXPECT_NEAR(number("maximum(norm(M*v), M in [zeros(2, 2), ones(2, 2)], v in [-1, [1; 1]])"),
              std::sqrt(8), 1e-14);
}

TEST_F(Extrema, OfJacobiansAreLipschitzConstants) {
  // J = [0, 1; 1 - 3 x(1)^2, 0]: its norm is max(1, |1 - 3 x(1)^2|).
  EXPECT_NEAR(number("maximum(norm(jacobian(duffing(x), x)), x in [[-2; -2], [2; 2]])"), 11, 1e-13);
}

TEST_F(Extrema, LieAboveAllPointsOfTheBox) {
  std::mt19937 random(4);
  const double found =
      number("maximum(norm(A*x)*sin(x(1)) + abs(x(2) - s), x in [[-2; -2], [2; 2]])");
  World at = world;
  for (int k = 0; k < 300; ++k) {
    at.set("p", 2 * random_matrix(random, 2, 1));
    EXPECT_LE(at("norm(A*p)*sin(p(1)) + abs(p(2) - s)")(0, 0), found + 1e-9);
  }
}

TEST_F(Extrema, OfANameThatDoesNotMatter) {
  EXPECT_EQ(number("maximum(3*s, x in [0, 1])"), 3 * 0.6);
  EXPECT_NEAR(number("maximum(u^2, x in [0, 1], u in [-3, 1], v in [0, 1])"), 9, 1e-14);
}

TEST_F(Extrema, NameThePointWithoutAValue) {
  expect_error("maximum(log(x), x in [-1, 1])", "at x = ");
  expect_error("maximum(norm(inv(x(1)*eye(2))) + x(2) + u, x in [[0; 1], [0; 2]], u in [1, 2])",
               "at x = [0; ");
  expect_error("maximum(exp(x), x in [0, 1e4])", "at x = ");
}

TEST_F(Extrema, RefuseEmptyBoxes) {
  expect_error("maximum(x(2), x in [[0; 2], [1; 1]])", "maximum: the box of x is empty: 2 > 1");
  expect_error("minimum(x, x in [1, s - 0.35])", "minimum: the box of x is empty: 1 > 0.25");
  EXPECT_EQ(number("maximum(x^2, x in [s, s])"), 0.6 * 0.6);
}

TEST_F(Extrema, RefuseOtherForms) {
  expect_error("maximum(x in [0, 1], x)", "is written maximum(f, x in [a, b])");
  expect_error("maximum(s, s)", "is written maximum(f, x in [a, b])");
  expect_error("maximum(s, s in [0, 1])", "'s' already has a meaning");
  expect_error("maximum(duffing, duffing in [0, 1])", "'duffing' already has a meaning");
  expect_error("maximum(x + x, x in [0, 1], x in [0, 1])", "'x' already has a meaning");
  expect_error("maximum(x, x in [0, 1], y in [0, x])", "unknown name 'x'");
  expect_error("maximum(A*x, x in [[0; 0], [1; 1]])", "expected 1 x 1");
  expect_error("maximum(x(1), x in [[0; 0], [1; 1; 1]])", "2 x 1");
  expect_error("maximum(x, x in [0; 1])", "',' between the ends of the box");
  expect_error("maximum(x, x in [0, 1, 2])", "']' after the ends of the box");
  expect_error("maximum(x, x in [0, inf])", "a number must be finite");
  expect_error("abs(x in [0, 1])", "a box is allowed only in maximum");
  expect_error("maximum(minimum(x*u, u in [0, 1]), x in [0, 1])",
               "write one with the names of both");
}

TEST_F(Extrema, AreOverConstants) {
  world.scope.symbols["xh"] = {{2, 1}, false, true};
  for (const char* text : {"maximum(x*xh(1), x in [0, 1])", "maximum(x, x in [0, norm(xh)])"})
    EXPECT_NE(input_error([&] { compile(text); }).message().find("'xh' changes along a run"),
              std::string::npos);
}

TEST_F(Extrema, KeepTheirNamesWhenOthersAreRenamed) {
  const auto to = [](const std::string& name) -> std::optional<std::string> {
    return name == "x" || name == "k" ? std::optional("ekf." + name) : std::nullopt;
  };
  std::vector<std::string> seen;
  const Expression changed = renamed(parse({"k*maximum(k*x, x in [0, 1]) + x", "test"}), to);
  visit_names(changed, [&](const Node& node) { seen.push_back(node.text); });
  EXPECT_EQ(std::ranges::count(seen, "ekf.k"), 2);
  EXPECT_EQ(std::ranges::count(seen, "ekf.x"), 1);
  EXPECT_EQ(std::ranges::count(seen, "x"), 0);
}

TEST_F(Extrema, SayWhatIsAnEstimate) {
  const auto label = [&](const std::string& text) {
    return to_string(estimate_of(compile(text), [](const std::string& input) {
      return input == "s" ? Estimate::from_below : Estimate::none;
    }));
  };
  EXPECT_EQ(label("maximum(x, x in [0, 1])"), "estimate from below");
  EXPECT_EQ(label("minimum(x, x in [0, 1])"), "estimate from above");
  EXPECT_EQ(label("1/minimum(x, x in [1, 2])"), "from estimates");
  EXPECT_EQ(label("maximum(x, x in [0, s])"), "from estimates");
  EXPECT_EQ(label("s"), "estimate from below");
  EXPECT_EQ(label("largest(1)*norm(A)"), "from estimates");
  EXPECT_EQ(label("norm(A)"), "");
  world.define("j(v)", "jacobian(v(1)*maximum(x*v(2), x in [0, 1]), v)");
  EXPECT_EQ(label("norm(A) + 0*s"), "from estimates");
}

}  // namespace
}  // namespace gainsmith::expr
