#include "io/yaml/problem_yaml.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

TEST(Problem, IsReadWhole) {
  const model::Problem problem = read_problem(kProblem);
  EXPECT_EQ(problem.name, "small");
  EXPECT_EQ(problem.file, "p.yaml");
  EXPECT_EQ(problem.text, kProblem);
  EXPECT_EQ(problem.method_name, "sampled-data-hybrid");
  EXPECT_EQ(problem.method_place, (Place{"p.yaml", 2, 1}));
  ASSERT_EQ(problem.data.size(), 5U);
  EXPECT_EQ(problem.data[1].name, "C");
  EXPECT_EQ(problem.data[1].place, (Place{"p.yaml", 5, 3}));
  ASSERT_EQ(problem.parameters.size(), 2U);
  EXPECT_EQ(problem.parameters[1].name, "a1");
  EXPECT_EQ(problem.synthesis.margin, 1e-6);
  EXPECT_EQ(problem.synthesis.gain_bound, 100);
}

TEST(Problem, HasACampaign) {
  using Law = model::LawKind;
  using Initial = model::StartKind;
  const model::Campaign campaign = read_problem(kProblem).campaign;
  EXPECT_EQ(campaign.runs, 20U);
  EXPECT_EQ(campaign.seed, 3U);
  EXPECT_TRUE(campaign.horizon);
  EXPECT_TRUE(campaign.first);
  ASSERT_EQ(campaign.sampling.size(), 3U);
  EXPECT_EQ(campaign.sampling[0].kind, Law::uniform);
  EXPECT_EQ(campaign.sampling[1].kind, Law::constant);
  EXPECT_EQ(campaign.sampling[2].kind, Law::list);
  EXPECT_EQ(campaign.sampling[2].values.size(), 2U);
  ASSERT_EQ(campaign.initial.size(), 3U);
  EXPECT_EQ(campaign.initial[0].kind, Initial::box);
  EXPECT_EQ(campaign.initial[1].kind, Initial::list);
  EXPECT_EQ(campaign.initial[1].values.size(), 2U);
  EXPECT_EQ(campaign.initial[2].kind, Initial::expression);
}

TEST(Problem, HasDefaultsForWhatIsLeftOut) {
  const model::Problem problem = read_problem("problem: a\nmethod: sampled-data-hybrid\n");
  const model::SynthesisOptions usual;
  EXPECT_EQ(problem.synthesis.margin, usual.margin);
  EXPECT_EQ(problem.synthesis.gain_bound, usual.gain_bound);
  EXPECT_EQ(problem.campaign.runs, model::Campaign().runs);
  EXPECT_TRUE(problem.campaign.sampling.empty());
  EXPECT_FALSE(problem.expect);
  EXPECT_TRUE(problem.data.empty());
}

TEST(Problem, DeclaresItsOwnNumbersThatDataRead) {
  const model::Problem problem =
      read_problem(replaced(kProblem, "A: [[0.2, -1.01], [1, 0]]",
                            "A: [[a, -1.01], [1, 0]]\n  a: b/5\n  b: 1\n  c: 3\n  M: [[1, 2]]"));
  const auto& data = problem.method->data;
  ASSERT_GT(data.size(), 3U);
  EXPECT_EQ(data[0].name, "a");
  EXPECT_EQ(data[1].name, "b");
  EXPECT_EQ(data[2].name, "A") << "nothing reads c and M";
  EXPECT_EQ(data[0].shape.text, "scalar");
}

TEST(Problem, ANumberOfItsOwnHasAFreeName) {
  const auto error = input_error([] {
    read_problem(
        replaced(kProblem, "A: [[0.2, -1.01], [1, 0]]", "A: [[n, -1.01], [1, 0]]\n  n: 1"));
  });
  EXPECT_EQ(error.place(), (Place{"p.yaml", 5, 3}));
  EXPECT_NE(error.message().find("'n', and has this name already ("), std::string::npos)
      << error.message();
}

TEST(Problem, TheGainBoundMayBeOff) {
  EXPECT_EQ(
      read_problem(replaced(kProblem, "gain_bound: 100", "gain_bound: none")).synthesis.gain_bound,
      std::nullopt);
}

TEST(Problem, MayHoldItsMethod) {
  std::string indented = "  " + kMethod;
  for (std::size_t at = indented.find('\n'); at + 1 < indented.size();
       at = indented.find('\n', at + 1))
    indented.insert(at + 1, "  ");
  const model::Problem problem = read_problem("problem: own\nmethod:\n" + indented);
  EXPECT_EQ(problem.method_name, "small");
  EXPECT_EQ(problem.method->require.size(), 2U);
  EXPECT_EQ(problem.method->require[1].place, (Place{"p.yaml", 19, 5}));
}

TEST(Problem, AMethodWithoutANameHasThatOfTheProblem) {
  const model::Problem problem = read_problem(
      "problem: mine\nmethod:\n  unknowns: {P: symmetric 2}\n  require: {positive: P > I}\n");
  EXPECT_EQ(problem.method_name, "mine");
}

class BrokenProblem : public testing::TestWithParam<Mistake> {};

TEST_P(BrokenProblem, IsRefusedAtItsPlace) {
  const Mistake& mistake = GetParam();
  const std::string text = replaced(kProblem, mistake.from, mistake.to);
  const InputError error = input_error([&] { read_problem(text); });
  const Place place =
      mistake.line == 0 ? Place{"p.yaml"} : Place{"p.yaml", mistake.line, mistake.column};
  EXPECT_EQ(error.place(), place) << mistake.to << ": " << error.what();
  EXPECT_NE(error.message().find(mistake.message), std::string::npos) << error.what();
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BrokenProblem,
    testing::Values(Mistake{"problem: small", "probelm: small", 1, 1, "did you mean 'problem'?"},
                    Mistake{"problem: small", "prob: small", 1, 1, "did you mean 'problem'?"},
                    Mistake{"problem: small\n", "", 1, 1, "the key 'problem' is missing"},
                    Mistake{"problem: small", "problem:", 1, 9, "found nothing"},
                    Mistake{"problem: small", "problem: [a]", 1, 10, "found a list"},
                    Mistake{"method: sampled", "methode: sampled", 2, 1, "did you mean 'method'?"},
                    Mistake{"method: sampled-data-hybrid\n", "", 1, 1,
                            "the key 'method' is missing"},
                    Mistake{"data:", "date:", 3, 1, "did you mean 'data'?"},
                    Mistake{"synthesis:", "sinthesis:", 10, 1, "did you mean 'synthesis'?"},
                    Mistake{"margin:", "margn:", 10, 13, "did you mean 'margin'?"},
                    Mistake{"runs:", "run:", 12, 3, "did you mean 'runs'?"},
                    Mistake{"sampling:", "samplings:", 16, 3, "did you mean 'sampling'?"},
                    Mistake{"box:", "bax:", 18, 9, "did you mean 'box'?"},
                    Mistake{"constant:", "constnat:", 16, 24, "did you mean 'constant'?"},
                    Mistake{"verdict:", "verdct:", 22, 3, "did you mean 'verdict'?"},
                    Mistake{"relative:", "realtive:", 27, 29, "did you mean 'relative'?"},
                    Mistake{"seed: 3", "runs: 3", 13, 3, "is given twice; first in line 12"},
                    Mistake{"    zh:", "    z:", 19, 5, "is given twice"}));

INSTANTIATE_TEST_SUITE_P(
    Values, BrokenProblem,
    testing::Values(
        Mistake{"sampled-data-hybrid", "sampled-data-hybrit", 2, 9,
                "unknown method 'sampled-data-hybrit'; did you mean 'sampled-data-hybrid'?"},
        Mistake{"sampled-data-hybrid", "wrong", 2, 9, "'gainsmith methods' lists them by task"},
        Mistake{"[[0.2, -1.01], [1, 0]]", "[[0.2, -1.01], [1]]", 4, 21, "first row has 2"},
        Mistake{"T1: 0.5", "T1: .nan", 6, 7, "finite"},
        Mistake{"QF: I", "QF: [1, 2", 8, 7, "a ']' is missing"},
        Mistake{"margin: 1e-6", "margin: 0", 10, 21, "positive"},
        Mistake{"margin: 1e-6", "margin: 1", 10, 21, "below 1"},
        Mistake{"margin: 1e-6", "margin: 2*3", 10, 21, "expected a number"},
        Mistake{"gain_bound: 100", "gain_bound: off", 10, 39, "expected a number"},
        Mistake{"gain_bound: 100", "gain_bound: -1", 10, 39, "positive"},
        Mistake{"gain_bound: 100", "gain_bound: [1]", 10, 39, "{gain: number, ...}"},
        Mistake{"gain_bound: 100", "gain_bound: {}", 10, 27, "for one gain at least"},
        Mistake{"gain_bound: 100", "gain_bound: {L: 0}", 10, 43, "positive"},
        Mistake{"runs: 20", "runs: 0", 12, 9, "from 1 to 1e15"},
        Mistake{"runs: 20", "runs: 1.5", 12, 9, "whole number"},
        Mistake{"runs: 20", "runs: 1e300", 12, 9, "whole number"},
        Mistake{"runs: 20", "runs: -5", 12, 9, "whole number"},
        Mistake{"seed: 3", "seed: -1", 13, 9, "from 0 to 1e15"},
        Mistake{"horizon: 10", "horizon: 10 +", 14, 16, "the end of the text"},
        Mistake{"horizon: 10", "horizon: [1]", 14, 12, "found a list"},
        Mistake{"[uniform,", "[unifrom,", 16, 14, "did you mean 'uniform'?"},
        Mistake{"[uniform,", "[constant,", 16, 14, "needs its value"},
        Mistake{"[uniform,", "[~,", 16, 14, "found nothing"},
        Mistake{"{list: [T1, T2]}", "{list: []}", 16, 46, "list of intervals"},
        Mistake{"{list: [T1, T2]}", "{list: T1}", 16, 46, "list of intervals"},
        Mistake{"{list: [T1, T2]}", "{constant: 1, list: [1]}", 16, 39, "expected {constant"},
        Mistake{"[-10, 10]}", "[-10]}", 18, 14, "expected [low, high]"},
        Mistake{"box: [-10, 10]", "box: 10", 18, 14, "expected [low, high]"},
        Mistake{"[[1, 2], [3, 4]]", "[]", 19, 16, "list of values"},
        Mistake{"th: C*z", "th: C**z", 20, 11, "write ^"}));

INSTANTIATE_TEST_SUITE_P(
    Expectations, BrokenProblem,
    testing::Values(Mistake{"verdict: yes", "verdict: maybe", 22, 12, "known: yes, no, undecided"},
                    Mistake{"status: optimal", "status: optimum", 23, 11,
                            "did you mean 'optimal'?"},
                    Mistake{"campaign: held", "campaign: hold", 24, 13, "did you mean 'held'?"},
                    Mistake{"active_bounds: [g]", "active_bounds: g", 25, 18, "expected a list"},
                    Mistake{"active_bounds: [g]", "active_bounds: [[g]]", 25, 19, "found a list"},
                    Mistake{"relative: 1e-3", "relative: -1", 27, 39, "must not be negative"},
                    Mistake{"relative: 1e-3", "relative: .nan", 27, 39, "expected a number"},
                    Mistake{"relative: 1e-3", "relative: small", 27, 39, "expected a number"},
                    Mistake{", relative: 1e-3", "", 27, 5, "expected a tolerance"},
                    Mistake{"value: 1.5, ", "", 27, 5, "expected a 'value' with its tolerance"},
                    Mistake{"objective:", "\"trace(\":", 27, 12, "expected"},
                    Mistake{"{value: 1.5, relative: 1e-3}", "1.5", 27, 16, "expected a mapping"}));

INSTANTIATE_TEST_SUITE_P(Files, BrokenProblem,
                         testing::Values(Mistake{kProblem, "", 0, 0, "empty"},
                                         Mistake{kProblem, "# none\n", 0, 0, "empty"},
                                         Mistake{kProblem, "[1, 2]", 1, 1, "expected a mapping"},
                                         Mistake{kProblem, "word", 1, 1, "found 'word'"},
                                         Mistake{"expect:", "---\nexpect:", 21, 1, "second"},
                                         Mistake{"data:", "data: [", 3, 7, "a ']' is missing"},
                                         Mistake{"small", "sm\x01ll", 1, 12, "control characters"},
                                         Mistake{"small", "sm\xE4ll", 1, 12, "UTF-8"}));

}  // namespace
}  // namespace gainsmith::io
