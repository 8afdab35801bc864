#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "numbers/types/real.h"

namespace gainsmith::io {
namespace {

using model::Dynamics;
using tests::input_error;

const std::string kPendulum = R"(problem: pendulum
method:
  method: pendulum
  data: {m: {shape: scalar, default: 2}}
  let: {f(x): "[x(2); -m*sin(x(1))]", C: "[1, 0]"}
  events: {sample: {every: [0.1, 0.2], lost: {probability: 0.1, in_a_row: 2}}}
  noise: {w: {normal: 0.1, new at: sample}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    output: {y: {value: x(1) + w, at: sample}}
    flow: {x: f(x)}
  observers:
    plain:
      state: {xh: {shape: 2, start: 0}}
      let: {L: "[0.5; 1]"}
      flow: {xh: f(xh)}
      at: {sample: {xh: xh + L*(y - C*xh)}}
    careful:
      like: plain
      let: {L: "[0.2; 0.4]"}
      mode: {q: 0}
      events: {far: {when: q == 0 and norm(xh) >= 3}}
      at: {far: {let: {k: 0.5}, xh: k*xh, q: 1}}
  signals: {e: x - xh, V: e'*e}
  claims: {shrinks: {shrinks: V, to: 0.1}}
campaign: {horizon: 10, sampling: {sample: golden}}
)";

TEST(Dynamics, ComponentsEventsAndSignalsAreBound) {
  const model::DesignPtr design = bound(kPendulum);
  ASSERT_TRUE(design->dynamics);
  const Dynamics& dynamics = *design->dynamics;
  std::vector<std::string> names;
  for (const Dynamics::Variable& variable : dynamics.variables) names.push_back(variable.name);
  EXPECT_EQ(names, (std::vector<std::string>{"x", "plain.xh", "careful.xh", "careful.q", "w"}));
  ASSERT_EQ(dynamics.events.size(), 2U);
  EXPECT_EQ(dynamics.events[0].name, "sample");
  EXPECT_EQ(dynamics.events[0].lost_in_a_row, 2);
  EXPECT_EQ(dynamics.events[1].name, "careful.far");
  EXPECT_EQ(dynamics.reactions.size(), 3U);
  ASSERT_EQ(design->claims.size(), 2U);
  EXPECT_EQ(design->claims[0].name, "plain.shrinks");
  EXPECT_EQ(design->claims[1].name, "careful.shrinks");
  ASSERT_EQ(design->campaign.laws.size(), 1U);
  EXPECT_EQ(design->campaign.laws[0].event, 0U);
}

TEST(Dynamics, NumbersOfEventsAreVariablesWhereTheyAreRead) {
  const std::string text =
      replaced(kPendulum, "V: e'*e", "V: e'*e + count(sample) + since(sample)");
  std::vector<std::string> names;
  const model::DesignPtr design = bound(text);
  for (const Dynamics::Variable& variable : design->dynamics->variables)
    names.push_back(variable.name);
  EXPECT_NE(std::find(names.begin(), names.end(), "count(sample)"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "since(sample)"), names.end());
  EXPECT_EQ(std::find(names.begin(), names.end(), "passes(sample)"), names.end());
}

TEST(Dynamics, ThePlantMayHaveDataThatObserversDoNotKnow) {
  const std::string text = kPendulum + "uncertain: {m: {box: [1.5, 2.5]}}\n";
  const model::DesignPtr design = bound(text);
  const Dynamics& dynamics = *design->dynamics;
  ASSERT_EQ(dynamics.noise.size(), 2U);
  const auto reads = [&](const std::string& state) {
    for (const Dynamics::Assignment& entry : dynamics.flow)
      if (dynamics.variables[entry.variable].name == state)
        return entry.value.program.uses("plant.m");
    return false;
  };
  EXPECT_TRUE(reads("x"));
  EXPECT_FALSE(reads("plain.xh"));
}

TEST(Dynamics, ThePlantHasWhatIsComputedFromUncertainData) {
  const model::DesignPtr design =
      bind::bind(io::read_problem(
                     "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  parameters: {c: "
                     "{default: 3*k}}\n"
                     "  plant: {state: {x: {shape: n, start: 0}}, flow: {x: c*A*x}}\n"
                     "  observer: {state: {xh: {shape: n, start: 0}}, flow: {xh: c*A*xh}}\n"
                     "data: {k: 2, m: 2*k, A: [[0, 1], [-m, -1]]}\nuncertain: {k: {box: [4, 5]}}\n"
                     "campaign: {runs: 2, horizon: 1}\n"))
          .design;
  const Dynamics& dynamics = *design->dynamics;
  for (const Dynamics::Assignment& entry : dynamics.flow) {
    const bool of_plant = dynamics.variables[entry.variable].name == "x";
    EXPECT_EQ(entry.value.program.uses("plant.k"), of_plant);
    EXPECT_EQ(entry.value.program.uses("A"), !of_plant);
    EXPECT_EQ(entry.value.program.uses("c"), !of_plant);
  }
}

struct Mistake {
  std::string what;
  std::string by;
  std::string message;
};

TEST(Dynamics, MistakesAreNamedAtTheirPlace) {
  const std::vector<Mistake> mistakes = {
      {"xh + L*(y - C*xh)", "xh + L*(x(1) - C*xh)", "'x' is a state of the plant"},
      {"flow: {xh: f(xh)}", "flow: {xh: f(xh) + L*y}", "'y' exists only at the event 'sample'"},
      {"at: {far:", "at: {fur:", "there is no event 'fur'; did you mean 'far'?"},
      {"when: q == 0 and norm(xh) >= 3", "when: 1 > 0", "never changes"},
      {"when: q == 0 and norm(xh) >= 3", "when: norm(xh)", "expected a condition"},
      {"like: plain", "like: plane", "there is no observer 'plane' before this one"},
      {"q: 1}", "r: 1}", "the jump of 'r', which is no state of careful"},
      {"q: 1}", "q: C}", "wrong shape"},
      {"norm(xh) >= 3", "norm(plain.xh) >= 3", "belongs to the observer plain"},
      {"every: [0.1, 0.2]", "every: x(1)", "changes along a run"},
      {"every: [0.1, 0.2]", "evry: 0.1", "every"},
      {"sampling: {sample: golden}", "sampling: {tick: golden}", "no event 'tick' with 'every'"},
      {"e: x - xh", "e: x - xz", "unknown name 'xz'"},
      {"mode: {q: 0}", "mode: {q: 0}\n      flow: {q: 1}", "does not flow"},
      {"when: q == 0 and norm(xh) >= 3", "rises: norm(xh) >= 3",
       "expected a number that changes its sign"},
      {"when: q == 0 and norm(xh) >= 3", "when: q == 0 && norm(xh) >= 3", "write 'and'"},
      {"let: {L: \"[0.2; 0.4]\"}", "let: {LL: \"[0.2; 0.4]\"}",
       "'LL' is no definition of plain, and nothing reads it; did you mean 'L'?"},
      {"{shrinks: V, to: 0.1}", "{shrinks: VV, to: 0.1}", "did you mean"},
      {"campaign:", "uncertain: {f: {box: [1, 2]}}\ncampaign:", "'f' is a definition"},
      {"flow: {x: f(x)}", "flow: {x: f(x)}\n    jump: {x: x}", "a jump is given under its event"},
      {"new at: sample", "new at: simple", "there is no event 'simple'"},
      {"every: [0.1, 0.2]", "every: [0.2, 0.1]", "expected 0 <= low <= high"},
      {"every: [0.1, 0.2]", "every: -1", "expected 0 <= low <= high"},
      {"every: [0.1, 0.2]", "at: []", "expected a time at least"},
      {"when: q == 0 and norm(xh) >= 3", "when: [q == 0]", "expected one expression, found a list"},
      {"sampling: {sample: golden}", "sampling: {sample: []}", "sampling"},
  };
  for (const Mistake& mistake : mistakes) {
    const auto error = input_error([&] { bound(replaced(kPendulum, mistake.what, mistake.by)); });
    EXPECT_NE(error.message().find(mistake.message), std::string::npos)
        << mistake.by << ": " << error.what();
    EXPECT_GT(error.place().line, 0) << mistake.by;
  }
}

TEST(Dynamics, WhatIsLeftOutOfACopyLeavesTheRestAsItIs) {
  const std::string text = replaced(kPendulum, "let: {L: \"[0.2; 0.4]\"}",
                                    "let: {L: none, K: 2, M: 3, N: \"[5; 7]\"}\n      flow: {xh: "
                                    "K*M*N}\n      at: {sample: {xh: N}}");
  const std::string once = replaced(text, "      at: {far: {let: {k: 0.5}, xh: k*xh, q: 1}}\n", "");
  const model::DesignPtr design = bound(
      replaced(once, "at: {sample: {xh: N}}", "at: {sample: {xh: N}, far: {xh: K*xh, q: 1}}"));
  const auto& flow = design->dynamics->flow.back().value.program;
  const numbers::Matrix rate = numbers::evaluate(flow, {});
  EXPECT_EQ(rate(0), 30);
  EXPECT_EQ(rate(1), 42);
}

TEST(Dynamics, LoopsHaveAnEnd) {
  const std::string loop = "{repeat: {xh: xh/2}, until: norm(xh) <= 1, at_most: 9, else: go on}";
  const std::string text =
      replaced(kPendulum, "{let: {k: 0.5}, xh: k*xh, q: 1}", "[{q: 1}, " + loop + "]");
  const model::DesignPtr design = bound(text);
  const Dynamics::Reaction& reaction = design->dynamics->reactions.back();
  ASSERT_EQ(reaction.passes.size(), 2U);
  EXPECT_FALSE(reaction.passes[0].repeats);
  EXPECT_TRUE(reaction.passes[1].repeats && reaction.passes[1].go_on);
  for (const std::string broken :
       {"{repeat: {xh: xh/2}}", "{repeat: {xh: xh/2}, until: norm(xh) <= 1}",
        "{repeat: {xh: xh/2}, times: 3, else: go on}"})
    EXPECT_THROW(bound(replaced(kPendulum, "{let: {k: 0.5}, xh: k*xh, q: 1}", broken)), InputError)
        << broken;
}

TEST(Dynamics, FiguresAreBoundToObserversAndEvents) {
  const std::string text = kPendulum +
                           "compare: [{peak: norm(e)}, {rms: norm(e), over: [1, 2]}]\n"
                           "expect: {run: [{observer: careful, at: {event: far}, value: t, is: 1, "
                           "absolute: 0.1}, {ended: horizon}]}\n";
  const model::DesignPtr design = bound(text);
  ASSERT_EQ(design->compare.size(), 4U);
  EXPECT_EQ(design->compare[1].observer, "careful");
  ASSERT_EQ(design->expect->run.size(), 2U);
  EXPECT_EQ(design->expect->run[0].figure.event, 1U);
  EXPECT_NE(input_error([&] {
              bound(kPendulum + "expect: {run: [{peak: norm(e), is: 1, absolute: 1}]}\n");
            })
                .message()
                .find("say of which"),
            std::string::npos);
  const auto message = [](const std::string& more) {
    return input_error([&] { bound(kPendulum + more); }).message();
  };
  EXPECT_NE(message("expect: {run: [{ended: hrizon}]}\n").find("did you mean 'horizon'?"),
            std::string::npos);
  EXPECT_NE(
      message("expect: {run: [{observer: careful, peak: norm(e), is: 1}]}\n").find("tolerance"),
      std::string::npos);
  EXPECT_NO_THROW(bound(kPendulum + "expect: {run: [{count: sample, is: 3}]}\n"));
  EXPECT_NO_THROW(bound(kPendulum + "expect: {run: [{count: sample, is: {below: 3}}]}\n"));
  EXPECT_NE(message("expect: {run: [{observer: careful, peak: norm(e), below: 3}]}\n")
                .find("is: {below: limit}"),
            std::string::npos);
  EXPECT_NE(message("expect: {run: [{observer: careful, settles: norm(e), is: {below: 3}}]}\n")
                .find("settles: expected the level"),
            std::string::npos);
  EXPECT_NE(message("expect: {run: [{count: sample, is: {}}]}\n").find("{below: limit"),
            std::string::npos);
  EXPECT_NE(message("expect: {run: [{count: sample, is: {above: 1}, absolute: 1}]}\n")
                .find("limits have none"),
            std::string::npos);
  EXPECT_NE(message("compare: [{ended: horizon}]\n").find("all observers end with the run"),
            std::string::npos);
}

}  // namespace
}  // namespace gainsmith::io
