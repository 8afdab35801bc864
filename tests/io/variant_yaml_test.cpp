// A problem that is like another one: what it takes, what it replaces, what it removes.
#include "io/yaml/variant_yaml.h"

#include <gtest/gtest.h>

#include <string>

#include "bind/bind.h"
#include "io/folder.h"
#include "io/json/gains_json.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

/// A problem with dynamics of its own.
const std::string kPendulum = R"(problem: pendulum
method:
  let: {f(x): "[x(2); -a*sin(x(1))]", C: "[1, 0]"}
  data: {a: scalar}
  inputs: {u: cos(t)}
  events: {sample: {every: 0.1}}
  plant: {state: {x: {shape: 2, start: [1, 0]}}, output: {y: C*x}, flow: {x: "f(x) + [0; u]"}}
  observers:
    plain:   {state: {xh: {shape: 2, start: 0}}, let: {L: "[0.2; 0.4]"}, flow: {xh: f(xh)}, at: {sample: {xh: xh + L*(y - C*xh)}}}
    careful: {like: plain, let: {L: "[0.1; 0.2]"}}
  signals: {e: x - xh}
  claims: {small: {below: norm(e), bound: 10}}
data: {a: 9.81}
campaign: {horizon: 5, initial: {x: {box: [-1, 1]}}}
expect: {campaign: held}
)";

class Variants : public Folder {
 protected:
  Variants() { write("base/pendulum.yaml", kPendulum); }

  model::Problem read(const std::string& rest) const {
    return parse_problem("problem: mine\nlike: base/pendulum.yaml\n" + rest, path("p.yaml"),
                         library());
  }
  InputError refused(const std::string& rest) const {
    return input_error([&] { bind::bind(read(rest)); });
  }
};

std::string text_of(const expr::Expression& expression) { return expression.text->str(); }

TEST_F(Variants, TakeAllButNameAndExpectations) {
  const model::Problem problem = read("");
  EXPECT_EQ(problem.name, "mine");
  EXPECT_FALSE(problem.expect);
  EXPECT_EQ(problem.method->observers.size(), 2U);
  EXPECT_EQ(problem.campaign.initial.size(), 1U);
  ASSERT_EQ(problem.files.size(), 1U);
  EXPECT_EQ(problem.files[0].name, "base/pendulum.yaml");
  EXPECT_EQ(problem.files[0].text, kPendulum);
  EXPECT_EQ(bind::bind(problem).values.at("a"), (numbers::Matrix{{9.81}}));
}

TEST_F(Variants, ReplaceEntriesByTheirNames) {
  const model::Problem problem = read(R"(data: {a: 1.62}
campaign: {initial: {x: {list: [[1, 2]]}}}
method:
  let: {C: "[0, 1]", f(z): "[z(2); -2*a*sin(z(1))]"}
  inputs: {u: 0}
  observers: {plain: {let: {L: "[0.5; 0.5]"}}}
)");
  EXPECT_EQ(bind::bind(problem).values.at("a"), (numbers::Matrix{{1.62}}));
  EXPECT_EQ(problem.campaign.initial[0].kind, model::StartKind::list);
  EXPECT_TRUE(problem.campaign.horizon);
  ASSERT_EQ(problem.method->let.size(), 2U);
  EXPECT_EQ(problem.method->let[0].signature.parameters[0], "z");
  EXPECT_EQ(text_of(problem.method->let[1].body), "[0, 1]");
  EXPECT_EQ(problem.method->observers[0].name, "plain");
  EXPECT_EQ(text_of(problem.method->observers[0].let[0].body), "[0.5; 0.5]");
  // The other one is like the first as it is now, with its own definition.
  EXPECT_EQ(text_of(problem.method->observers[1].let[0].body), "[0.1; 0.2]");
}

TEST_F(Variants, RemoveWithNone) {
  const model::Problem problem =
      read("method: {observers: {careful: none}, claims: {small: none}}\n");
  EXPECT_EQ(problem.method->observers.size(), 1U);
  EXPECT_TRUE(problem.method->claims.empty());
  EXPECT_EQ(read("campaign: {initial: none}\n").campaign.initial.size(), 0U);
  // What an observer has of the one that it is like is removed in it.
  const model::Problem open = read(
      "method: {observers: {plain: {let: {K: \"[0; 0]\"}, at: {sample: {xh: xh + K*(y - C*xh)}}}, "
      "careful: {let: {L: none}, at: {sample: none}}}}\n");
  EXPECT_TRUE(open.method->observers[1].at.empty());
  // Without a bound is no removal.
  EXPECT_FALSE(read("synthesis: {gain_bound: none}\n").synthesis.gain_bound);
}

TEST_F(Variants, ASectionWithoutEntriesChangesNothing) {
  EXPECT_EQ(read("data:\n").data.size(), 1U);
}

TEST_F(Variants, CannotChangeAMethodThatIsOnlyNamed) {
  write("named.yaml", kProblem);
  const InputError error = input_error([&] {
    parse_problem("problem: p\nlike: named.yaml\nmethod: {claims: {cost: none}}\n", path("p.yaml"),
                  library());
  });
  EXPECT_EQ(error.place(), (Place{path("p.yaml"), 3, 9}));
  EXPECT_NE(error.message().find("write 'method: {like: sampled-data-hybrid, ...}'"),
            std::string::npos)
      << error.message();
  EXPECT_FALSE(parse_problem("problem: p\nlike: named.yaml\nmethod: {like: sampled-data-hybrid, "
                             "claims: {cost: none}}\n",
                             path("p.yaml"), library())
                   .method->claims.empty());
}

const std::string kNoisy = R"(problem: noisy
method:
  like: observer
  noise: {v: {normal: 0.1, every: 0.5}}
  plant: {output: {y: C*x + v}}
  claims: {lyapunov: none}
data: {A: [[0, 1], [-1, 0]], C: [1, 0]}
)";

TEST_F(Variants, TheMethodMayBeLikeOneOfTheProgram) {
  const model::Problem noisy = parse_problem(kNoisy, path("p.yaml"), library());
  const model::Problem plain =
      parse_problem("problem: p\nmethod: observer\ndata: {A: [[0, 1], [-1, 0]], C: [1, 0]}\n",
                    path("q.yaml"), library());
  EXPECT_EQ(noisy.method_name, "noisy");
  EXPECT_EQ(noisy.method->noise.size(), 1U);
  EXPECT_EQ(noisy.method->claims.size() + 1, plain.method->claims.size());
  EXPECT_EQ(noisy.method->require.size(), plain.method->require.size());
  // The gain file states the text that it takes the rest from.
  model::Gains gains;
  gains.version = "0.1.0";
  gains.statement = bind::bind(noisy).design->statement;
  gains = parse_gains(gains_text(gains), path("gains.json"));
  const model::Problem stated = stated_problem(gains, path("gains.json"));
  EXPECT_EQ(bind::bind(stated).design->statement.hash, gains.statement.hash);
}

TEST_F(Variants, WhatTheMethodOfTheOtherOneTakesFromTheProgramIsRemoved) {
  write("noisy.yaml", kNoisy);
  const auto variant = [&](const std::string& method) {
    return parse_problem("problem: p\nlike: noisy.yaml\nmethod: {" + method + "}\n", path("p.yaml"),
                         library());
  };
  const model::Problem noisy = parse_problem(kNoisy, path("q.yaml"), library());
  EXPECT_EQ(variant("claims: {error: none}").method->claims.size() + 1,
            noisy.method->claims.size());
  // What the two have goes away in both, and what the other problem alone has goes away too.
  EXPECT_TRUE(variant("plant: {output: {y: none}}").method->plant.outputs.empty());
  EXPECT_TRUE(variant("noise: {v: none}").method->noise.empty());
  // A claim without entries is that of the program again.
  EXPECT_EQ(variant("claims: {lyapunov: {}}").method->claims.size(),
            noisy.method->claims.size() + 1);
  const InputError error = input_error([&] { variant("claims: {eror: none}"); });
  EXPECT_EQ(error.place(), (Place{path("p.yaml"), 3, 25}));
  EXPECT_NE(error.message().find("did you mean 'error'?"), std::string::npos) << error.message();
}

TEST_F(Variants, OfMethodsSayWhereAMistakeStands) {
  struct Case {
    std::string was, is;
    Place place;
    const char* says;
  };
  for (const Case& one :
       {Case{"like: observer", "like: observr", {path("p.yaml"), 3, 9}, "did you mean 'observer'?"},
        Case{"lyapunov: none",
             "lyapunof: none",
             {path("p.yaml"), 6, 22},
             "did you mean 'lyapunov'?"},
        Case{"like: observer", "like: [1]", {path("p.yaml"), 3, 9}, "like"},
        Case{"C*x + v", "C*x + vv", {path("p.yaml"), 5, 29}, "vv"}}) {
    const InputError error = input_error([&] {
      bind::bind(parse_problem(replaced(kNoisy, one.was, one.is), path("p.yaml"), library()));
    });
    EXPECT_EQ(error.place(), one.place) << error.what();
    EXPECT_NE(error.message().find(one.says), std::string::npos) << error.what();
  }
}

TEST_F(Variants, MayBeLikeVariants) {
  write("base/moon.yaml", "problem: moon\nlike: pendulum.yaml\ndata: {a: {csv: a.csv}}\n");
  write("base/a.csv", "1.62\n");
  const model::Problem problem = parse_problem(
      "problem: p\nlike: base/moon.yaml\ncampaign: {seed: 5}\n", path("p.yaml"), library());
  EXPECT_EQ(bind::bind(problem).values.at("a"), (numbers::Matrix{{1.62}}));
  EXPECT_EQ(problem.campaign.seed, 5U);
  ASSERT_EQ(problem.files.size(), 3U);
  EXPECT_EQ(problem.files[2].name, "base/a.csv");
}

TEST_F(Variants, SayWhereAMistakeStands) {
  const std::string base = path("base/pendulum.yaml");
  struct Case {
    std::string rest;
    Place place;
    const char* says;
  };
  for (const Case& one :
       {Case{"data: {b: 1}\n", {path("p.yaml"), 3, 8}, "has no datum 'b'"},
        Case{"method: {observers: {carefull: {let: {L: 1}}}}\n",
             {path("p.yaml"), 3, 22},
             "'carefull' is not in "},
        Case{"method: {let: {D: none}}\n", {path("p.yaml"), 3, 19}, "there is no 'D' in "},
        Case{"method: {inputs: {U: 0}}\n", {path("p.yaml"), 3, 19}, "did you mean 'u'?"},
        Case{"campaign: {initial: {z: 1}}\n", {path("p.yaml"), 3, 22}, "'z'"},
        Case{"data: 3\n", {path("p.yaml"), 3, 7}, "expected a mapping"},
        Case{"data: {a: 1, a: 2}\n", {path("p.yaml"), 3, 14}, "is given twice"},
        Case{"dta: {a: 1}\n", {path("p.yaml"), 3, 1}, "unknown key 'dta'"},
        Case{"method: {let: {f(x): \"[x(3); 0]\"}}\n",
             {path("p.yaml"), 3, 26},
             "the index 3 is outside 1:2"}}) {
    const InputError error = refused(one.rest);
    EXPECT_EQ(error.place(), one.place) << error.what();
    EXPECT_NE(error.message().find(one.says), std::string::npos) << error.what();
  }
  // A mistake in the other file is shown there.
  write("base/pendulum.yaml", replaced(kPendulum, "below: norm(e)", "below: norm(ee)"));
  const InputError error = refused("");
  EXPECT_EQ(error.place().file, base);
  EXPECT_EQ(error.place().line, 12);
}

TEST_F(Variants, RefuseCirclesAndWhatIsNotThere) {
  const auto error_of = [&](const std::string& like) {
    return input_error(
        [&] { parse_problem("problem: p\nlike: " + like + "\n", path("p.yaml"), library()); });
  };
  write("a.yaml", "problem: a\nlike: b.yaml\n");
  write("b.yaml", "problem: b\nlike: ./a.yaml\n");
  write("list.yaml", "[1, 2]\n");
  write("empty.yaml", "\n");
  write("broken.yaml", "problem: b\n  x: [\n");
  EXPECT_NE(error_of("p.yaml").message().find("leads back to itself"), std::string::npos);
  const InputError circle = error_of("a.yaml");
  EXPECT_NE(circle.message().find(
                "p.yaml, which is like a.yaml, which is like b.yaml, which is like a.yaml"),
            std::string::npos)
      << circle.message();
  EXPECT_EQ(circle.place(), (Place{path("b.yaml"), 2, 7}));
  EXPECT_EQ(error_of("c.yaml").place(), (Place{path("p.yaml"), 2, 7}));
  EXPECT_NE(error_of("bb.yaml").message().find("did you mean 'b.yaml'?"), std::string::npos);
  write("gains.json", "{\"gainsmith\": \"0.1.0\"}\n");
  EXPECT_NE(error_of("gains.json").message().find("is a gain file"), std::string::npos);
  EXPECT_NE(error_of("\"\"").message().find("expected the name of a file"), std::string::npos);
  EXPECT_NE(error_of("base").message().find("no ordinary file"), std::string::npos);
  EXPECT_EQ(error_of("list.yaml").place().file, path("list.yaml"));
  EXPECT_EQ(error_of("empty.yaml").place().file, path("empty.yaml"));
  EXPECT_EQ(error_of("broken.yaml").place().file, path("broken.yaml"));
  EXPECT_LE(error_of("broken.yaml").place().line, 3);
}

TEST_F(Variants, AGainFileStatesWhatTheyAreLike) {
  write("base/moon.yaml", "problem: moon\nlike: pendulum.yaml\ndata: {a: {csv: a.csv}}\n");
  write("base/a.csv", "1.62\n");
  const model::Problem problem =
      parse_problem("problem: p\nlike: base/moon.yaml\n", path("p.yaml"), library());
  model::Gains gains;
  gains.version = "0.1.0";
  gains.statement = bind::bind(problem).design->statement;
  gains = parse_gains(gains_text(gains), path("out/gains.json"));
  std::filesystem::remove_all(path("base"));
  const model::Problem stated = stated_problem(gains, path("out/gains.json"));
  EXPECT_EQ(bind::bind(stated).values.at("a"), (numbers::Matrix{{1.62}}));
  EXPECT_EQ(bind::bind(stated).design->statement.hash, gains.statement.hash);
  // It is not what stands there now.
  write("out/base/pendulum.yaml", kPendulum + "\n");
  EXPECT_NE(input_error([&] { stated_problem(gains, path("out/gains.json")); })
                .message()
                .find("pendulum.yaml has changed since"),
            std::string::npos);
}

}  // namespace
}  // namespace gainsmith::io
