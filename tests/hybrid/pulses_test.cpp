#include "hybrid/pulses.h"

#include <gtest/gtest.h>

#include "expr/binding/compile.h"
#include "expr/binding/scope.h"

namespace gainsmith::hybrid {
namespace {

bool pulses(const std::string& text) {
  expr::Scope scope;
  scope.symbols["t"] = {expr::Shape{1, 1}};
  scope.symbols["x"] = {expr::Shape{1, 1}};
  return has_pulses(expr::compile(expr::parse(expr::Text::generated(text, {})), scope),
                    [](const std::string& name) { return name == "t"; });
}

TEST(Pulses, AreWhatRisesAndFallsWithinLittleTime) {
  for (const char* text : {"exp(-((t - 5)/0.01)^2)", "1/(1 + ((t - 5)/0.01)^2)",
                           "x*exp(-(t - x)^2)", "tanh(99*(t - 5)) - tanh(99*(t - 5.1))",
                           "1/(1 + exp(-t)) - x", "1/(exp(99*(t - 5)) + exp(-99*(t - 5)))"})
    EXPECT_TRUE(pulses(text)) << text;
  for (const char* text : {"exp(-t)*x", "sin(t)", "1/(2 + sin(t))", "exp(sin(3*t))",
                           "tanh(t - 5)*x", "exp(-x^2)", "x/(1 + x^2)", "t^2*x", "x/(1 + t)"})
    EXPECT_FALSE(pulses(text)) << text;
}

}  // namespace
}  // namespace gainsmith::hybrid
