// The judge draws again what a run drew: runs of the simulator, and the same with another draw.
#include <gtest/gtest.h>

#include <functional>

#include "expr/binding/compile.h"
#include "expr/program/rewrite.h"
#include "expr/text/parser.h"
#include "judge/judge.h"
#include "simulate/simulator.h"
#include "support/dynamics_text.h"
#include "support/reference_run.h"

namespace gainsmith::judge {
namespace {

using model::LawKind;
using tests::DynamicsText;
using tests::has_fault;
using tests::place_of;
using tests::to_text;

model::Formula number(const std::string& decimal) {
  expr::Composer compose({});
  return {compose.take(compose.number(decimal)), {}, decimal};
}

DynamicsText sampled() {
  DynamicsText text;
  text.state("x", 2, "[x(2); -sin(x(1))]", "")
      .symmetric("P", 2, "-P")
      .state("z", 1, "", "x(1)")
      .state("n", 2, "", "")
      .state("m", 2, "", "")
      .every("sample", "0.1", "0.3")
      .lost(0.4, 2)
      .every("tick", "0.2")
      .first("0.05", "0.15")
      .every("maybe", "0.1", "0.4")
      .only_if("x(1) > 0")
      .noise("w", model::Dynamics::NoiseKind::normal, {"0", "0.1"})
      .drawn_at("sample")
      .noise("v", model::Dynamics::NoiseKind::uniform, {"-1", "2"})
      .drawn_every("0.25")
      .noise("u", model::Dynamics::NoiseKind::uniform, {"0", "1"})
      .drawn_at("maybe")
      .noise("g", model::Dynamics::NoiseKind::normal,
             {"[1; 0; -1]", "[4, 1.9, 1.9; 1.9, 1, 1; 1.9, 1, 1]"}, 3)
      .covariance()
      .drawn_every("0.3")
      .noise("l", model::Dynamics::NoiseKind::lognormal, {"[2; -3]", "[0.5; 0.1]"}, 2)
      .drawn_at("sample")
      .observer("observer")
      .state("xh", 1, "v", "0")
      .reacts("sample", {{"xh", "xh + w"}})
      .reacts("maybe", {{"xh", "xh + u"}});
  return text;
}

/// A clock whose lengths reach 0, one of one length, and a state in a hollow ellipsoid.
DynamicsText of_corners() {
  DynamicsText text;
  text.state("x", 2, "-x", "").every("soon", "0", "0.3").every("even", "0.3").first("0.1", "0.3");
  return text;
}

struct Drawn {
  model::Dynamics dynamics;
  model::Stated stated;
  model::Design::Campaign campaign;
  hybrid::Trajectory run;
  std::uint64_t seed = 5, number_of_run;

  explicit Drawn(std::uint64_t number_given, std::vector<model::Design::Law> laws = {})
      : dynamics(sampled().dynamics()), stated(sampled().stated()), number_of_run(number_given) {
    campaign.horizon = number("6");
    campaign.laws = std::move(laws);
    campaign.starts.push_back({static_cast<std::size_t>(slot("x")),
                               model::StartKind::box,
                               {number("-1"), number("1.5")},
                               {}});
    campaign.starts.push_back({static_cast<std::size_t>(slot("P")),
                               model::StartKind::box,
                               {number("0"), number("1")},
                               {}});
    campaign.starts.push_back({static_cast<std::size_t>(slot("n")),
                               model::StartKind::normal,
                               {number("3"), number("0.2")},
                               {}});
    campaign.starts.push_back({static_cast<std::size_t>(slot("m")),
                               model::StartKind::lognormal,
                               {number("3"), number("0.2")},
                               {}});
    const hybrid::System system = hybrid::make_system(dynamics, stated.values);
    const hybrid::Scenario scenario = hybrid::make_scenario(campaign, system);
    run = simulate::Simulator(system, scenario).run(seed, number_of_run);
  }
  std::size_t slot(const std::string& name) const {
    for (std::size_t v = 0; v < dynamics.variables.size(); ++v)
      if (dynamics.variables[v].name == name) return v;
    return 0;
  }
  std::vector<Fault> judged() const {
    Question question;
    question.drawn = DrawnFrom{seed, number_of_run, &campaign};
    return check_trajectory(run, dynamics, stated, question);
  }
  /// The first jump of an event for which `wanted` holds, or the number of parts.
  std::size_t jump(const std::string& event,
                   const std::function<bool(const hybrid::JumpPoint&)>& wanted = {}) const {
    const std::size_t number_of_event = tests::event_of(dynamics, event);
    for (std::size_t k = 0; k < run.parts.size(); ++k)
      if (const auto* jump = std::get_if<hybrid::JumpPoint>(&run.parts[k]))
        if (jump->event == number_of_event && (!wanted || wanted(*jump))) return k;
    return run.parts.size();
  }
};

TEST(JudgedDraws, WhatTheSimulatorDrawsIsDrawn) {
  for (std::uint64_t run = 0; run < 10; ++run) {
    const auto faults = Drawn(run).judged();
    EXPECT_TRUE(faults.empty()) << "run " << run << "\n" << to_text(faults);
  }
}

TEST(JudgedDraws, LawsOfTheCampaignAndOfOneEvent) {
  const std::vector<model::Design::Law> laws = {
      {LawKind::golden, {}, {}, {}},
      {LawKind::list, {number("0.15"), number("0.2")}, {}, {}},
      {LawKind::constant, {number("0.25")}, {}, 0},
  };
  for (std::uint64_t run = 0; run < 4; ++run) {
    const auto faults = Drawn(run, laws).judged();
    EXPECT_TRUE(faults.empty()) << "run " << run << "\n" << to_text(faults);
  }
}

TEST(JudgedDraws, LengthsFrom0AHollowStartAndAGivenFirstTime) {
  const model::Dynamics dynamics = of_corners().dynamics();
  const model::Stated stated = of_corners().stated();
  model::Design::Campaign campaign;
  campaign.horizon = number("3");
  campaign.first = number("0.3");
  const auto formula = [](const std::string& text) {
    return model::Formula{expr::compile(expr::parse(expr::Text(text, "")), {}), {}, text};
  };
  campaign.starts.push_back({0,
                             model::StartKind::ellipsoid,
                             {formula("[0; 0]"), formula("[2, 0; 0, 1]"), formula("[1, 1.2]")},
                             {}});
  const hybrid::System system = hybrid::make_system(dynamics, stated.values);
  const hybrid::Scenario scenario = hybrid::make_scenario(campaign, system);
  for (std::uint64_t run = 0; run < 6; ++run) {
    const hybrid::Trajectory trajectory = simulate::Simulator(system, scenario).run(5, run);
    Question question;
    question.drawn = DrawnFrom{5, run, &campaign};
    const auto faults = check_trajectory(trajectory, dynamics, stated, question);
    EXPECT_TRUE(faults.empty()) << "run " << run << "\n" << to_text(faults);
  }
}

TEST(JudgedDraws, AnotherSeedOrRunIsFound) {
  Drawn other(3);
  other.seed = 6;
  const auto faults = other.judged();
  EXPECT_TRUE(has_fault(faults, 0, "starts where it is not drawn: x")) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 0, "starts where it is not drawn: P")) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 0, "noise that is not drawn so: v")) << to_text(faults);
  Drawn next(5);
  next.number_of_run = 10;
  EXPECT_TRUE(has_fault(next.judged(), next.jump("sample"), "jumps when it is not drawn: sample"))
      << to_text(next.judged());
}

TEST(JudgedDraws, AStartIsFound) {
  for (const std::string name : {"P", "n", "m"}) {
    Drawn drawn(0);
    drawn.run.start(place_of(drawn.dynamics, name) + 1) += 1e-6;
    EXPECT_TRUE(has_fault(drawn.judged(), 0, "starts where it is not drawn: " + name));
  }
}

TEST(JudgedDraws, ALossIsFound) {
  Drawn drawn(0);
  const auto lost = [](const hybrid::JumpPoint& jump) { return jump.lost; };
  const std::size_t at = drawn.jump("sample", lost);
  ASSERT_LT(at, drawn.run.parts.size());
  std::get<hybrid::JumpPoint>(drawn.run.parts[at]).lost = false;
  EXPECT_TRUE(has_fault(drawn.judged(), at, "is not lost as it is drawn: sample"))
      << to_text(drawn.judged());
}

TEST(JudgedDraws, NoiseOfAnEventIsFound) {
  for (const std::string name : {"w", "u", "l"}) {
    Drawn drawn(0);
    const std::size_t at = drawn.jump(name == "u" ? "maybe" : "sample");
    ASSERT_LT(at, drawn.run.parts.size());
    std::get<hybrid::JumpPoint>(drawn.run.parts[at]).before(place_of(drawn.dynamics, name)) += 1e-9;
    EXPECT_TRUE(has_fault(drawn.judged(), at, "noise that is not drawn so: " + name))
        << to_text(drawn.judged());
  }
}

TEST(JudgedDraws, NoiseOfTheTimeIsFound) {
  Drawn drawn(0);
  for (std::size_t k = 0; k < drawn.run.parts.size(); ++k) {
    auto* piece = std::get_if<hybrid::FlowPiece>(&drawn.run.parts[k]);
    if (piece == nullptr || piece->to() < 1 || piece->steps.size() < 2) continue;
    piece->steps.back().coefficients(place_of(drawn.dynamics, "v"), 0) += 1e-9;
    EXPECT_TRUE(has_fault(drawn.judged(), k, "noise that is not drawn so: v"))
        << to_text(drawn.judged());
    return;
  }
  FAIL();
}

/// A run of another length of a clock, right in everything else.
TEST(JudgedDraws, ALengthIsFound) {
  Drawn drawn(0);
  model::Design::Campaign other = drawn.campaign;
  other.laws = {{LawKind::list, {number("0.2"), number("0.25"), number("0.11")}, {}, 0}};
  const hybrid::System system = hybrid::make_system(drawn.dynamics, drawn.stated.values);
  drawn.run = simulate::Simulator(system, hybrid::make_scenario(other, system))
                  .run(drawn.seed, drawn.number_of_run);
  const std::size_t at = drawn.jump("sample");
  EXPECT_TRUE(has_fault(drawn.judged(), at, "jumps when it is not drawn: sample"))
      << to_text(drawn.judged());
}

}  // namespace
}  // namespace gainsmith::judge
