#include "gainsmith/campaign_json.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "gainsmith/figures_json.h"
#include "io/json/json_fields.h"

namespace gainsmith::io {

template <>
inline constexpr auto kWords<claims::Termination> = std::array{
    claims::Termination::horizon, claims::Termination::lost, claims::Termination::broken_off};
template <>
inline constexpr auto kWords<model::ClaimKind> =
    std::array{model::ClaimKind::nonincreasing, model::ClaimKind::cost, model::ClaimKind::shrinks,
               model::ClaimKind::below, model::ClaimKind::above};

}  // namespace gainsmith::io

namespace gainsmith::app {

namespace {

using io::Json;
using io::JsonReader;

constexpr auto kFindingFields = [](auto& at, auto& finding) {
  at("judgement", finding.judgement);
  at("score", finding.score);
  at("value", finding.value);
  at("bound", finding.bound);
  at("rounding", finding.rounding);
  at("t", finding.t);
  at("j", finding.j);
  at("floor", finding.floor);
  at("sampled", finding.sampled);
  at("ended", finding.ended);
  at("disputed", finding.disputed);
  at("tolerance", finding.tolerance);
};

constexpr auto kWorstRunFields = [](auto& at, auto& worst) {
  at("run", worst.run);
  at("judgement", worst.judgement);
  at("score", worst.score);
  at("termination", worst.termination);
};

constexpr auto kUnfinishedFields = [](auto& at, auto& first) {
  at("run", first.run);
  at("termination", first.termination);
  at("message", first.message);
};

constexpr auto kUndecidedFields = [](auto& at, auto& first) {
  kUnfinishedFields(at, first);
  at("check", first.check);
  at("finding", first.finding, kFindingFields);
};

constexpr auto kClaimTallyFields = [](auto& at, auto& claim) {
  at("violations", claim.violations);
  at("undecided", claim.undecided);
  at("run", claim.run);
  at("worst", claim.worst, kFindingFields);
  at("floor", claim.floor);
};

constexpr auto kTallyFields = [](auto& at, auto& tally) {
  at("runs", tally.runs);
  at("violations", tally.violations);
  at("undecided", tally.undecided);
  at("unfinished", tally.unfinished);
  at("repeated", tally.repeated);
  at("careful", tally.careful);
  at("open", tally.open);
  at("confirmed", tally.confirmed);
  at.some("worst", tally.worst, kWorstRunFields);
  at.some("first_unfinished", tally.first_unfinished, kUnfinishedFields);
  at.some("first_undecided", tally.first_undecided, kUndecidedFields);
  at("claims", tally.claims, kClaimTallyFields);
  at("happened", tally.happened);
};

constexpr auto kClaimFactsFields = [](auto& at, auto& claim) {
  at("claim", claim.name);
  at("kind", claim.kind);
  at("missing", claim.missing);
  at("growing", claim.growing);
};

constexpr auto kFactsFields = [](auto& at, auto& facts) {
  at("runs", facts.asked);
  at("seed", facts.seed);
  at("confidence", facts.confidence);
  at("horizon", facts.horizon);
  at("many_at_once", facts.many_at_once);
  at.some("different_runs", facts.different);
  at("events", facts.events);
  at("doubts", facts.doubts);
  at("claims", facts.claims, kClaimFactsFields);
};

constexpr auto kCarefulFields = [](auto& at, auto& careful) {
  at("findings", careful.findings, kFindingFields);
  at("termination", careful.termination);
  at("message", careful.message);
};

/// A run that was made again: one by one, or to confirm a violation.
constexpr auto kRepeatFields = [](auto& at, auto& entry) {
  auto& [run, repeat] = entry;
  at("run", run);
  if (io::kReads<decltype(at)> ? at.has("findings") : repeat.careful.has_value()) {
    if constexpr (io::kReads<decltype(at)>) repeat.careful.emplace();
    kCarefulFields(at, *repeat.careful);
  }
  at.some("confirmed", repeat.confirmed);
};

}  // namespace

Json to_json(const verify::CampaignFacts& facts) {
  return io::record_json(facts, kFactsFields, io::JsonNumbers::exact);
}

verify::CampaignFacts facts_from(const JsonReader& reader) {
  verify::CampaignFacts facts;
  io::read_record(reader, facts, kFactsFields, io::JsonNumbers::exact);
  return facts;
}

Json runs_json(const verify::CampaignPart& part) {
  Json document = {{"ranges", ranges_json(part.runs)},
                   {"tally", io::record_json(part.tally, kTallyFields, io::JsonNumbers::exact)}};
  if (part.figures.runs.count() > 0) document["figures"] = to_json(part.figures);
  return document;
}

void read_runs(const JsonReader& reader, verify::CampaignPart& part) {
  part.runs = ranges_from(reader.at("ranges"));
  verify::Tally& tally = part.tally = {};
  io::read_record(reader.at("tally"), tally, kTallyFields, io::JsonNumbers::exact);
  if (tally.runs > 0 && !tally.worst) reader.at("tally").fail("the key 'worst' is missing");
  std::size_t stated = 0;
  for (const verify::ClaimFacts& claim : part.facts.claims) stated += claim.stated() ? 1 : 0;
  if (tally.runs != part.runs.count()) reader.fail("another number of runs than the ranges have");
  if (tally.runs > 0 &&
      (tally.claims.size() != stated || tally.happened.size() != part.facts.events.size()))
    reader.fail("another number of claims or events than the campaign has");
  if (reader.has("figures")) part.figures = survey_from(reader.at("figures"));
}

Json repeats_json(const verify::CampaignPart& part) {
  Json list = Json::array();
  for (const auto& entry : part.repeats)
    list.push_back(io::record_json(entry, kRepeatFields, io::JsonNumbers::exact));
  return list;
}

void read_repeats(const JsonReader& reader, verify::CampaignPart& part) {
  for (const JsonReader& item : reader.items()) {
    std::pair<std::uint64_t, verify::Repeat> entry;
    io::read_record(item, entry, kRepeatFields, io::JsonNumbers::exact);
    part.repeats.insert_or_assign(entry.first, std::move(entry.second));
  }
}

}  // namespace gainsmith::app
