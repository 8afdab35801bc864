// Data that are linear systems.
#include <gtest/gtest.h>

#include <string>

#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;
using tests::YamlProblem;

std::string text_of(const std::string& shape, const std::string& data) {
  return "problem: p\nmethod:\n  method: m\n  data: {G: " + shape +
         "}\n  unknowns: {P: symmetric n}\n  require: {decay: He(P*G.A) < 0}\n" + data;
}

TEST(SystemData, TellTheirSizes) {
  const YamlProblem problem(
      text_of("system n p x m", "data: {G: \"ss([0, 1; -2, -3], [0; 1], [1, 0], 0)\"}\n"));
  const model::Dimensions& known = problem.instance.design->dimensions;
  EXPECT_EQ(known.at("n"), 2);
  EXPECT_EQ(known.at("p"), 1);
  EXPECT_EQ(known.at("m"), 1);
  EXPECT_EQ(problem.instance.design->unknowns.front().shape, (expr::Shape{2, 2}));
}

TEST(SystemData, AreRefusedAtTheirPlaces) {
  const auto says = [](const std::string& shape, const std::string& data, const std::string& part) {
    const std::string what = input_error([&] { YamlProblem{text_of(shape, data)}; }).what();
    EXPECT_NE(what.find(part), std::string::npos) << what;
  };
  says("system n 2 x m", "data: {G: \"tf(1, [1, 2])\"}\n",
       ":7:8: the datum G is declared system n 2 x m; found 1 states, 1 outputs and 1 inputs");
  says("system n", "data: {}\n", "the datum G (system n) of the method m is missing");
  says("system n m", "data: {G: \"tf(1, [1, 2])\"}\n",
       "expected system, system n or system n p x m");
  says("sytem n", "data: {G: 1}\n", "did you mean 'system'?");
}

/// A problem of its own needs no declaration.
TEST(SystemData, NeedNoDeclaration) {
  const YamlProblem problem(
      "problem: p\nmethod: {}\ndata: {k: 2, G: \"k*tf(1, [1, 2])\"}\nfigures: {loop: {bode: "
      "3*G}}\n");
  EXPECT_EQ(problem.instance.design->pictures.front().systems.front().states, 1);
}

}  // namespace
}  // namespace gainsmith::bind
