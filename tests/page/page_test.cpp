#include "page/page.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/yaml/problem_yaml.h"
#include "drawing/xml.h"

namespace gainsmith::page {
namespace {

constexpr const char* kOdd = "<script>alert('1')</script> & \"\xC3\xBC\" \xFF";

/// The elements of a page; its declaration of the type is no XML of this reader.
std::vector<test::Element> elements(const std::string& page) {
  const std::string begin = "<!DOCTYPE html>\n";
  EXPECT_TRUE(page.starts_with(begin));
  const auto found = test::read_xml(page.substr(begin.size(), page.size() - begin.size() - 1));
  EXPECT_TRUE(found) << page;
  return found.value_or(std::vector<test::Element>{});
}

bool has(const std::vector<test::Element>& all, const std::string& name) {
  return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
}

/// Results whose every text is odd.
Results odd_results() {
  Results results;
  results.name = results.verdict_line = results.solver_line = kOdd;
  results.objective_line = results.search_lines = results.campaign_line = results.no_campaign =
      kOdd;
  results.unreadable = results.picture_title = kOdd;
  results.differences = {kOdd};
  results.files = {{kOdd, kOdd}};
  model::Gains& gains = results.gains;
  gains.verdict = model::Verdict::no;
  gains.problem_name = gains.version = gains.solver.message = gains.solver.precision = kOdd;
  gains.statement.problem_text = gains.statement.method_text = gains.statement.method_name = kOdd;
  gains.statement.problem_file = gains.statement.hash = kOdd;
  const numbers::Matrix one = numbers::Matrix::Ones(1, 1);
  gains.gains = gains.unknowns = gains.report = {{kOdd, one}};
  gains.estimates = {{kOdd, kOdd}};
  gains.searched = {{kOdd, 1.0}};
  gains.gain_functions = {
      {kOdd, kOdd, model::GainFunction::Kind::formula, kOdd, {}},
      {kOdd, kOdd, model::GainFunction::Kind::polynomial, kOdd, {one, one, one}}};
  gains.margins = {{kOdd, true, 0.5, 1e-9, 1, kOdd, false}};
  gains.bounds = {{kOdd, 1, 2, true}};
  gains.certificate = model::CertificateRecord{false, 1e-9, 31, {{kOdd, one}}, kOdd};
  gains.timings = {{kOdd, 1.0}};
  model::CampaignRecord campaign;
  campaign.unfinished = campaign.repeated = campaign.runs = 1;
  campaign.first_unfinished = {0, kOdd};
  campaign.first_undecided = {0, kOdd};
  campaign.notes = {kOdd};
  model::ClaimRecord claim;
  claim.name = claim.kind = kOdd;
  campaign.checks = {claim};
  claim.stated = false;
  claim.missing = {kOdd};
  campaign.checks.push_back(claim);
  results.campaign = campaign;
  return results;
}

TEST(Page, TextsOfUsersAreNoMarkup) {
  Results failed;
  failed.name = failed.error = kOdd;
  for (const std::vector<Results>& all :
       {std::vector{odd_results()}, std::vector{odd_results(), odd_results(), failed}}) {
    const auto found = elements(page(all, kOdd));
    EXPECT_FALSE(has(found, "script"));
    EXPECT_TRUE(has(found, "math"));
  }
}

TEST(Page, UndecidedRunsAreCountedAndTheFirstSaysWhy) {
  Results results = odd_results();
  results.campaign->undecided = 3;
  results.campaign->first_undecided = {12, "nothing is certain of 1 &lt;= 1"};
  const std::string text = page({results}, "t");
  EXPECT_NE(text.find("3 runs undecided; first run 12: nothing is certain"), std::string::npos);
  EXPECT_NE(text.find("--run 12 --plot run-12.svg"), std::string::npos);
}

TEST(Page, OfAnOptimumTheCommandSaysWhatLimitsIt) {
  Results results = odd_results();
  results.gains.statement.problem_file = "motor.yaml";
  results.gains.verdict = model::Verdict::yes;
  results.gains.objective = 2;
  const std::string command = "gainsmith explain motor.yaml";
  EXPECT_NE(page({results}, "t").find(command), std::string::npos);
  results.gains.objective.reset();
  EXPECT_EQ(page({results}, "t").find(command), std::string::npos);
}

TEST(Page, NothingIsLoaded) {
  for (const auto& element : elements(page({odd_results(), odd_results()}, "t")))
    for (const auto& [name, value] : element.attributes) {
      EXPECT_NE(name, "src");
      EXPECT_TRUE(name != "href" || value.starts_with("#")) << value;
    }
}

Results some_results() {
  Results results;
  results.gains.version = "0.1.0";
  return results;
}

TEST(Page, CellsHaveTheirHeadsForNarrowPages) {
  const std::string text = page({odd_results(), odd_results()}, "t");
  for (const char* cell : {"<td data-head=\"margin\">0.5</td>", "<td data-head=\"claim\">",
                           "<td data-head=\"allowed\">1</td>", "<td data-head=\"problem\"><a"})
    EXPECT_NE(text.find(cell), std::string::npos) << cell;
}

TEST(Page, ANameOfSeveralWordsIsText) {
  Results results = some_results();
  results.gains.report = {{"largest factor", numbers::Matrix::Ones(1, 1)}};
  EXPECT_NE(page({results}, "t").find(">largest factor</span>"), std::string::npos);
}

TEST(Page, TheLargestPicturesAreLeftOut) {
  Results huge = some_results();
  huge.name = "p";
  huge.picture = "<svg><text>" + std::string(page_size / 2, 'x') + "</text></svg>\n";
  huge.picture_title = "Run 0";
  // Of small ones the sentences that tell it count too.
  const std::string text = page(std::vector<Results>(7, huge), "t");
  EXPECT_LE(text.size(), page_size);
  EXPECT_NE(text.find("the picture is left out"), std::string::npos);
  const std::string alone = page({huge}, "t");
  EXPECT_NE(alone.find("<svg>"), std::string::npos);
}

TEST(Page, AYesOfFormulasClaimsNoProof) {
  Results formulas = some_results();
  formulas.gains.verdict = model::Verdict::yes;
  EXPECT_NE(page({formulas}, "t").find("no inequalities"), std::string::npos);
  formulas.gains.margins = {{"flow", true, 0.5, 1e-9, 1, "", true}};
  EXPECT_NE(page({formulas}, "t").find("is a proof for the decimals"), std::string::npos);
}

TEST(Page, AChangedGainFileIsTold) {
  Results results = some_results();
  EXPECT_EQ(page({results}, "t").find("is not the one that was run"), std::string::npos);
  results.changed = true;
  EXPECT_NE(page({results}, "t").find("is not the one that was run"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::page
