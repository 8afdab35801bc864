// Families: one text for all members gives what the members written one by one give.
#include <gtest/gtest.h>

#include "design/solve.h"
#include "support/input_error.h"

namespace gainsmith::design {
namespace {

using tests::input_error;

/// A matrix with eigenvalues left of -1/8.
numbers::Matrix random_stable(RandomStream& random, int n) {
  const numbers::Matrix S = random_symmetric(random, n);
  numbers::Matrix A = S - S.triangularView<Eigen::StrictlyLower>().toDenseMatrix() * 2;
  A.diagonal() = -S.diagonal().cwiseAbs().array() - 0.125;
  return A;
}

const std::string kDwell = R"yaml(  data:
    A: {shape: n x n, for: i in 1..N}
    T: {shape: scalar, for: i in 1..N}
  unknowns: {P: {shape: symmetric n, for: i in 1..N}}
  let: {E(i): expm(A(i)*T(i))}
  require:
    positive: {forall: i in 1..N, that: P(i) > 0}
    flow: {forall: i in 1..N, that: He(P(i)*A(i)) < 0}
    switch: {forall: [i in 1..N, j in 1..N, i != j], that: "E(i)'*P(j)*E(i) < P(i)"
}
)yaml";

TEST(FamilyDesign, IsThatOfItsMembersOneByOne) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    RandomStream random(0xFA, seed);
    const int N = 2 + static_cast<int>(seed % 3);
    std::string list, data, single, names, let, positive, flow, jumps;
    for (int i = 1; i <= N; ++i) {
      const std::string I = std::to_string(i);
      const std::string A = tests::matrix_yaml(random_stable(random, 2));
      list += (i > 1 ? ", " : "") + A;
      data += (i > 1 ? ", A" : "A") + I + ": " + A;
      single += (i > 1 ? ", A" : "A") + I + ": n x n";
      names += (i > 1 ? ", P" : "P") + I + ": symmetric n";
      positive += "    positive" + I + ": P" + I + " > 0\n";
      flow += "    flow" + I + ": He(P" + I + "*A" + I + ") < 0\n";
      for (int j = 1; j <= N; ++j)
        if (i != j)
          jumps += "    switch" + I + std::to_string(j) + ": expm(A" + I + "*0.5)'*P" +
                   std::to_string(j) + "*expm(A" + I + "*0.5) < P" + I + "\n";
    }
    const model::Gains family = solve(kDwell, "data: {A: [" + list + "], T: 0.5}\n");
    const model::Gains members = solve("  data: {" + single + "}\n  unknowns: {" + names +
                                           "}\n  require:\n" + positive + flow + jumps,
                                       "data: {" + data + "}\n");
    EXPECT_EQ(family.verdict, members.verdict) << seed;
    ASSERT_EQ(family.unknowns.size(), members.unknowns.size());
    for (std::size_t k = 0; k < family.unknowns.size(); ++k) {
      EXPECT_EQ(family.unknowns[k].first, "P_" + std::to_string(k + 1));
      EXPECT_EQ(family.unknowns[k].second, members.unknowns[k].second) << seed;
    }
    ASSERT_EQ(family.margins.size(), members.margins.size());
    for (std::size_t k = 0; k < family.margins.size(); ++k)
      EXPECT_EQ(family.margins[k].reached, members.margins[k].reached) << family.margins[k].name;
    EXPECT_EQ(family.margins.back().name,
              "switch at i = " + std::to_string(N) + ", j = " + std::to_string(N - 1));
  }
}

TEST(FamilyDesign, GainsAndFunctionsCarryTheIndex) {
  const model::Gains gains = solve(R"yaml(  data: {A: {shape: n x n, for: i in 1..N}, h: N}
  unknowns: {P: {shape: symmetric n, for: i in 1..N, of: s, in: [0, 1], degree: i}}
  require:
    above: {forall: [i in 1..N, "s in [0, 1]"], that: P(i)(s) > I}
    below: {forall: [i in 1..N, "s in [0, 1]"], that: P(i)(s) + derivative(P(i))(s) < i*3*I}
    each: {forall: x in h, that: x*P(1)(0) > 0}
  gains: {"K(i in 1..N)": inv(P(i)(0))*A(i), "L(i in 1..2)(s)": A(i)*P(i)(s)}
)yaml",
                                   "data: {A: [[[0, 1], [2, 3]], 2*I], h: [1, 2]}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  ASSERT_EQ(gains.gains.size(), 2U);
  EXPECT_EQ(gains.gains[0].first, "K_1");
  EXPECT_EQ(gains.gains[1].first, "K_2");
  ASSERT_EQ(gains.functions.size(), 2U);
  EXPECT_EQ(gains.functions[1].signature, "P_2(s)");
  EXPECT_EQ(gains.unknowns.size(), 5U) << "degrees 1 and 2";
}

TEST(FamilyDesign, AVariableStandsOnceInForall) {
  for (const std::string list :
       {"i in 1..3, i in 1..2", "\"t in [0, 3]\", \"t in [0, 2]\"", "i in 1..5, \"i in [0, 2]\""}) {
    const std::string message = input_error([&] {
                                  solve("  unknowns: {x: scalar}\n  require: {a: {forall: [" +
                                        list + "], that: x > 1}}\n  minimize: x\n");
                                }).message();
    EXPECT_NE(message.find("twice"), std::string::npos) << list << message;
  }
}

/// A member of a family of scalars is searched under its name.
TEST(FamilyDesign, AMemberMayBeOverridden) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {T: {shape: scalar, for: i in 1..2}}\n"
      "  unknowns: {x: scalar}\n  require: {a: {forall: i in 1..2, that: x >= T(i)}}\n"
      "  minimize: x\ndata: {T: [1, 2]}\n");
  const model::Gains gains = synthesize_at(yaml.instance.design, {{"T_1", 5}}, {});
  EXPECT_NEAR(*gains.objective, 5, 1e-6);
  EXPECT_THROW(synthesize_at(yaml.instance.design, {{"T", 5}}, {}), InputError);
}

TEST(FamilyDesign, ChainsNameTheMember) {
  const model::Gains gains = solve(
      "  data: {a: {shape: scalar, for: i in 1..2, default: i}}\n"
      "  unknowns: {x: {shape: scalar, for: i in 1..2}}\n"
      "  require: {bounds: {forall: i in 1..2, that: a(i) < x(i) < 2*a(i)}}\n");
  ASSERT_EQ(gains.margins.size(), 4U);
  EXPECT_EQ(gains.margins[3].name, "bounds.2 at i = 2");
  EXPECT_TRUE(model::is_comparison_of("bounds.2 at i = 2", "bounds at i = 2"));
  EXPECT_FALSE(model::is_comparison_of("bounds.2 at i = 2", "bounds at i = 1"));
  EXPECT_FALSE(model::is_comparison_of("bounds_2", "bounds"));
}

TEST(FamilyDesign, MistakesAreNamed) {
  const auto message = [](const std::string& method, const std::string& data) {
    return input_error([&] { solve(method, data); }).message();
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"data: {A: [[[0]], [[1]]], T: [1, 2, 3]}\n",
       "the family T has 2 members by the data before it; found 3"},
      {"data: {A: [[[0]], [[1, 2]]], T: 1}\n", "a family takes a list with a matrix for each"},
      {"data: {T: 1}\n", "the datum A (n x n for each index) of the method m is missing"},
      {"data: {A: -I, T: [1, 2]}\n", "must be a whole number known beforehand, not 'N'"},
      {"data: {A: [[[[1]]]], T: 1}\n", "this member is one itself: a bracket too many"},
      {"data: {A: [[[-1]], [[-2]]], T: 1}\nsearch: {largest: {T_7: [1, 3]}}\n",
       "has no scalar datum or parameter 'T_7'; did you mean 'T_1'?"},
      {"data: {A: [[[-1]], [[-2]]], T: 1}\nparameters: {k: [[[1]]]}\n",
       "expected a number or an expression here, found a list"},
      {"data: {A: [[[-1]], [[-2]]], T: 1}\nexpect: {values: {P_1: {value: [[[1]]], absolute: "
       "1}}}\n",
       "expected a number or an expression here, found a list"},
      {"data: {A: [[[-1]], [[-2]]]}\n",
       "the datum T (scalar for each index) of the method m is missing"}};
  for (const auto& [data, expected] : cases) {
    const std::string found = message(kDwell, data);
    EXPECT_NE(found.find(expected), std::string::npos) << data << found;
  }
  const std::string plain =
      "  data: {A: n x n}\n  unknowns: {P: symmetric n}\n  require: {p: P > A}\n";
  EXPECT_NE(message(plain, "data: {A: [[[1]], [[2]]]}\n").find("found a list of matrices"),
            std::string::npos);
  EXPECT_NE(
      message(
          "  unknowns: {x: scalar}\n  require: {p: {forall: [i in 1..1000, j in 1..1000, i == j], "
          "that: x > i}}\n",
          "")
          .find("the indices have more than 100000 values"),
      std::string::npos);
  for (const char* const text : {"  unknowns: {x: scalar}\n  require: {p: x != 3}\n",
                                  "  data: {k: scalar}\n  assume: {c: k != 2}\n  unknowns: {x: "
                                  "scalar}\n  require: {p: x > k}\n"})
    EXPECT_NE(message(text, std::string(text).find("data") != std::string::npos ? "data: {k: 1}\n" : "")
                  .find("'!=' compares indices only"),
              std::string::npos)
        << text;
  EXPECT_NE(message("  unknowns: {P: {shape: scalar, for: i in 1..2}, P_1: scalar}\n"
                    "  require: {p: P(1) + P_1 > 0}\n",
                    "")
                .find("'P_1' is the name of a member of P, which is a family"),
            std::string::npos);
}

}  // namespace
}  // namespace gainsmith::design
