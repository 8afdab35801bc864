// The same problem in other units of its states, outputs, data and time has the same answer: with
// powers of two the same verdict with the same margins to the last digit, otherwise the same
// verdict.
#include <gtest/gtest.h>

#include <optional>

#include "design/synthesize.h"
#include "properties/families.h"
#include "support/yaml_problem.h"

namespace gainsmith::tests::properties {
namespace {

constexpr std::uint64_t kCasesInUnits = 12;

model::Gains solved(const std::string& family, std::uint64_t index,
                    std::optional<OtherUnits> others) {
  const Case made = make_case(kSeed, index, family, others);
  return design::synthesize(YamlProblem(made.text).instance, {});
}

class UnitsTest : public testing::TestWithParam<std::string> {};

TEST_P(UnitsTest, PowersOfTwoChangeNoDigit) {
  for (std::uint64_t index = 0; index < kCasesInUnits; ++index) {
    if (!make_case(kSeed, index, GetParam()).easy) continue;
    const model::Gains one = solved(GetParam(), index, {});
    const model::Gains other = solved(GetParam(), index, OtherUnits{7, true});
    ASSERT_EQ(one.verdict, other.verdict) << GetParam() << " " << index;
    // Beyond double the coefficients are those of the decimals, which differ in their last digits;
    // so do certificates, which are made in 100.
    if (one.solver.precision == "double" && one.verdict == model::Verdict::yes) {
      EXPECT_EQ(one.solver.iterations, other.solver.iterations) << GetParam() << " " << index;
    }
    ASSERT_EQ(one.margins.size(), other.margins.size());
    for (std::size_t k = 0; k < one.margins.size(); ++k)
      EXPECT_EQ(one.margins[k].reached, other.margins[k].reached) << GetParam() << " " << index;
  }
}

TEST_P(UnitsTest, OtherFactorsChangeNoVerdict) {
  for (std::uint64_t index = 0; index < kCasesInUnits; ++index) {
    if (!make_case(kSeed, index, GetParam()).easy) continue;
    EXPECT_EQ(solved(GetParam(), index, {}).verdict,
              solved(GetParam(), index, OtherUnits{7, false}).verdict)
        << GetParam() << " " << index;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, UnitsTest,
                         testing::Values("lyapunov", "stein", "bounded-real", "observer",
                                         "discrete-observer", "common", "diagonal", "pair", "kink"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase(name, '-');
                           return name;
                         });

/// The jump maps J expm(A tau), tau in [T1, T2], of a sampled plant have one norm in which all
/// shrink.
std::string sampled_text(const ExactMatrix& A, const ExactMatrix& J, const Exact& first,
                         const Exact& last) {
  return "problem: sampled\nmethod:\n  method: sampled\n"
         "  data: {A: n x n, J: n x n, T1: scalar, T2: scalar}\n  unknowns: {P: symmetric n}\n"
         "  require:\n    positive: P > 0\n    jump: {forall: \"tau in [T1, T2]\", that: "
         "\"(J*expm(A*tau))'*P*J*expm(A*tau) < P\"}\nno campaign: nothing moves\ndata:\n  A: " +
         yaml(A) + "\n  J: " + yaml(J) + "\n  T1: " + decimal(first) + "\n  T2: " + decimal(last) +
         "\n";
}

/// What is shown for all tau in states of one size is shown in states of sizes from 1e-6 to 1e6.
TEST(SampledUnits, ChangeNoVerdict) {
  constexpr int kWanted = 20;
  int found = 0;
  for (std::uint64_t index = 0; found < kWanted; ++index) {
    ASSERT_LT(index, 10 * kWanted) << "too few feasible cases";
    RandomStream stream(kSeed, index);
    const auto between = [&](int low, int high) {
      return low + static_cast<int>(stream.uniform() * (high - low + 1));
    };
    const int n = between(2, 4);
    ExactMatrix A(n, n), J(n, n), S(n, n), inverse(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        A(i, j) = Exact(between(-150, 150)) / 100;
        J(i, j) = Exact(between(-70, 70)) / 100;
      }
    const Exact first = Exact(between(10, 50)) / 100;
    const Exact last = first + Exact(between(20, 150)) / 100;
    for (int i = 0; i < n; ++i) {
      S(i, i) = ten_to(between(-6, 6)) * two_to(between(0, 2));
      inverse(i, i) = 1 / S(i, i);
    }
    const auto verdict = [&](const ExactMatrix& a, const ExactMatrix& b) {
      return design::synthesize(YamlProblem(sampled_text(a, b, first, last)).instance, {}).verdict;
    };
    const model::Verdict one = verdict(A, J);
    if (one != model::Verdict::yes) continue;
    ++found;
    EXPECT_EQ(verdict(inverse * A * S, inverse * J * S), one) << index;
  }
}

}  // namespace
}  // namespace gainsmith::tests::properties
