#include "io/json/campaign_json.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/json/result_json.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

constexpr double infinity = std::numeric_limits<double>::infinity();

model::CampaignRecord campaign() {
  model::CampaignRecord record;
  record.verdict = model::CampaignVerdict::violated;
  record.runs = 900;
  record.runs_asked = 1000;
  record.seed = 18446744073709551615U;
  record.horizon = 12.5;
  record.violations = 2;
  record.undecided = 1;
  record.unfinished = 1;
  record.first_unfinished = {17, "escapes \"<b>\""};
  record.first_undecided = {3, "nothing is certain of 1 <= 1"};
  record.worst_run = 17;
  record.repeated = 3;
  record.confirmed = {17, 18};
  record.confidence = 0.95;
  record.violation_probability = 0.01;
  record.notes = {"note \xC3\xBC"};
  record.message = "interrupted";
  record.version = "0.1.0";
  record.gains_hash = "abc";
  model::ClaimRecord claim;
  claim.name = "small";
  claim.kind = "stays below";
  claim.violations = 2;
  claim.worst = {0.5, 3, std::nullopt, 1e-9, 2.5, 4};
  claim.tolerance = 1e-6;
  model::ClaimRecord void_one;
  void_one.name = "other";
  void_one.kind = "shrinks";
  void_one.stated = false;
  void_one.missing = {"P"};
  record.checks = {claim, void_one};
  model::FigureRecord settles;
  settles.figure = "settles norm(e)";
  settles.observer = "fast";
  settles.runs = 5;
  settles.without = 2;
  settles.unknown = 2;
  settles.why = "t = 3: chaos";
  settles.error = 1e-3;
  settles.least = 0.1;
  settles.least_error = 1e-9;
  settles.largest = infinity;
  settles.least_run = 3;
  settles.largest_run = 4;
  settles.resolution = 1e-3;
  settles.quantiles = {{0.5, 0.125, 0.1, std::nullopt}, {0.95, infinity, -infinity, infinity}};
  model::FigureRecord squares;
  squares.figure = "nees e at t = 1";
  squares.consistency = {"undecided", 3, 2, 1.0625, 2, 0.5, std::nullopt, 0.95};
  record.figures = {9, 10, 5, 0.95, {settles, squares}};
  return record;
}

TEST(CampaignJson, IsReadAsItWasWritten) {
  const model::CampaignRecord record = campaign();
  const std::string text = to_text(to_json(record));
  const model::CampaignRecord read = parse_campaign(text, "campaign.json");
  EXPECT_EQ(to_text(to_json(read)), text);
  EXPECT_EQ(read.seed, record.seed);
  EXPECT_FALSE(read.checks[0].worst.bound);
  EXPECT_EQ(read.figures->figures[0].largest, infinity);
  EXPECT_EQ(read.figures->figures[0].unknown, 2U);
  EXPECT_EQ(read.figures->figures[0].least_error, 1e-9);
  EXPECT_FALSE(read.figures->figures[1].consistency->high);
  EXPECT_EQ(read.first_undecided->run, 3U);
  EXPECT_EQ(read.checks[1].missing, std::vector<std::string>{"P"});
}

TEST(CampaignJson, MistakesAreFoundWithTheirPlace) {
  const std::string text = to_text(to_json(campaign()));
  const auto error = [](const std::string& mistaken) {
    return std::string(input_error([&] { parse_campaign(mistaken, "campaign.json"); }).what());
  };
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return changed.replace(at, from.size(), to);
  };
  EXPECT_NE(error(text.substr(0, text.size() / 2)).find("campaign.json:"), std::string::npos);
  EXPECT_NE(error(replaced("\"runs\": 900", "\"runs\": -1")).find("campaign.json:3"),
            std::string::npos);
  EXPECT_NE(error(replaced("\"violated\"", "\"lost\"")).find("held, violated or undecided"),
            std::string::npos);
  EXPECT_NE(error(replaced("\"0.1.0\"", "\"99.0.0\"")).find("99.0.0"), std::string::npos);
  EXPECT_NE(error(replaced("\"gainsmith\"", "\"other\"")).find("of an earlier version"),
            std::string::npos);
  EXPECT_NE(error("[]").find("this is no campaign"), std::string::npos);
}

TEST(GainsHash, LeavesTimingsOut) {
  model::Gains gains;
  gains.version = "0.1.0";
  const std::string hash = gains_hash(gains);
  gains.timings = {{"total", 3}};
  EXPECT_EQ(gains_hash(gains), hash);
  gains.gains = {{"L", numbers::Matrix::Ones(1, 1)}};
  EXPECT_NE(gains_hash(gains), hash);
}

TEST(ResultJson, IsReadAsItWasWritten) {
  const Json report = {{"problem", "p"},   {"folder", "p"},        {"exit", 1},
                       {"verdict", "yes"}, {"no_campaign", "why"}, {"differences", {"a", "b"}}};
  const RunResult read =
      parse_result(to_text(result_json(report, "../p.yaml", "abc", 1.5)), "result.json");
  EXPECT_EQ(read.exit, 1);
  EXPECT_EQ(read.problem_file, "../p.yaml");
  EXPECT_EQ(read.no_campaign, "why");
  EXPECT_EQ(read.differences, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(read.gains_hash, "abc");
  EXPECT_EQ(read.seconds, 1.5);
  const Json failed = {{"folder", "p"}, {"exit", 2}, {"error", "p.yaml:1:1: bad"}};
  EXPECT_EQ(parse_result(to_text(result_json(failed, "", "", 0)), "result.json").error,
            "p.yaml:1:1: bad");
  Json without_hash = result_json(report, "", "", 1);
  EXPECT_NE(
      std::string(input_error([&] { parse_result(to_text(without_hash), "result.json"); }).what())
          .find("gains_sha256"),
      std::string::npos);
  const InputError error =
      input_error([] { parse_result("{\"gainsmith\": \"0.1.0\"}", "result.json"); });
  EXPECT_EQ(error.place().file, "result.json");
  EXPECT_NE(error.message().find("exit"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::io
