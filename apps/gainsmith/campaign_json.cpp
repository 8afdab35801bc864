#include "gainsmith/campaign_json.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "gainsmith/exact_number.h"
#include "gainsmith/figures_json.h"

namespace gainsmith::app {

namespace {

using io::Json;
using io::JsonReader;

/// The value of a text among those that are possible.
template <class Value, std::size_t N>
Value word(const JsonReader& reader, const std::array<Value, N>& values) {
  for (const Value value : values)
    if (to_string(value) == reader.text()) return value;
  reader.fail("unknown word");
}

claims::Judgement judgement_from(const JsonReader& reader) {
  using enum model::CampaignVerdict;
  return word(reader, std::array{held, violated, undecided});
}

claims::Termination termination_from(const JsonReader& reader) {
  using enum claims::Termination;
  return word(reader, std::array{horizon, lost, broken_off});
}

model::ClaimKind kind_from(const JsonReader& reader) {
  using enum model::ClaimKind;
  return word(reader, std::array{nonincreasing, cost, shrinks, below, above});
}

std::vector<std::string> texts_from(const JsonReader& reader) {
  std::vector<std::string> texts;
  for (const JsonReader& item : reader.items()) texts.push_back(item.text());
  return texts;
}

template <class Items, class Convert>
Json list(const Items& items, const Convert& convert) {
  Json all = Json::array();
  for (const auto& item : items) all.push_back(convert(item));
  return all;
}

Json finding_json(const claims::Finding& finding) {
  return {{"judgement", to_string(finding.judgement)},
          {"score", bits(finding.score)},
          {"value", bits(finding.value)},
          {"bound", bits(finding.bound)},
          {"rounding", bits(finding.rounding)},
          {"t", bits(finding.t)},
          {"j", finding.j},
          {"floor", bits(finding.floor)},
          {"sampled", finding.sampled},
          {"ended", finding.ended},
          {"disputed", finding.disputed},
          {"tolerance", bits(finding.tolerance)}};
}

claims::Finding finding_from(const JsonReader& reader) {
  claims::Finding finding;
  finding.judgement = judgement_from(reader.at("judgement"));
  finding.score = from_bits(reader.at("score"));
  finding.value = from_bits(reader.at("value"));
  finding.bound = from_bits(reader.at("bound"));
  finding.rounding = from_bits(reader.at("rounding"));
  finding.t = from_bits(reader.at("t"));
  finding.j = static_cast<std::int64_t>(reader.at("j").count());
  finding.floor = from_bits(reader.at("floor"));
  finding.sampled = reader.at("sampled").truth();
  finding.ended = reader.at("ended").truth();
  finding.disputed = reader.at("disputed").truth();
  finding.tolerance = from_bits(reader.at("tolerance"));
  return finding;
}

std::vector<claims::Finding> findings_from(const JsonReader& reader) {
  std::vector<claims::Finding> findings;
  for (const JsonReader& item : reader.items()) findings.push_back(finding_from(item));
  return findings;
}

Json tally_json(const verify::Tally& tally) {
  Json document = {{"runs", tally.runs},           {"violations", tally.violations},
                   {"undecided", tally.undecided}, {"unfinished", tally.unfinished},
                   {"repeated", tally.repeated},   {"careful", tally.careful},
                   {"open", tally.open},           {"confirmed", tally.confirmed}};
  if (const auto& worst = tally.worst)
    document["worst"] = {{"run", worst->run},
                         {"judgement", to_string(worst->judgement)},
                         {"score", bits(worst->score)},
                         {"termination", to_string(worst->termination)}};
  if (const auto& first = tally.first_unfinished)
    document["first_unfinished"] = {{"run", first->run},
                                    {"termination", to_string(first->termination)},
                                    {"message", first->message}};
  if (const auto& first = tally.first_undecided)
    document["first_undecided"] = {{"run", first->run},
                                   {"termination", to_string(first->termination)},
                                   {"message", first->message},
                                   {"check", first->check},
                                   {"finding", finding_json(first->finding)}};
  document["claims"] = list(tally.claims, [](const verify::ClaimTally& claim) -> Json {
    return {{"violations", claim.violations},
            {"undecided", claim.undecided},
            {"run", claim.run},
            {"worst", finding_json(claim.worst)},
            {"floor", bits(claim.floor)}};
  });
  document["happened"] = list(tally.happened, [](char event) { return Json(event != 0); });
  return document;
}

void read_firsts(const JsonReader& reader, verify::Tally& tally) {
  if (reader.has("first_unfinished")) {
    const JsonReader first = reader.at("first_unfinished");
    tally.first_unfinished = {first.at("run").count(), termination_from(first.at("termination")),
                              first.at("message").text()};
  }
  if (reader.has("first_undecided")) {
    const JsonReader first = reader.at("first_undecided");
    tally.first_undecided = {first.at("run").count(), termination_from(first.at("termination")),
                             first.at("message").text(), first.at("check").count(),
                             finding_from(first.at("finding"))};
  }
}

verify::Tally tally_from(const JsonReader& reader) {
  verify::Tally tally;
  tally.runs = reader.at("runs").count();
  tally.violations = reader.at("violations").count();
  tally.undecided = reader.at("undecided").count();
  tally.unfinished = reader.at("unfinished").count();
  tally.repeated = reader.at("repeated").count();
  tally.careful = reader.at("careful").count();
  const std::vector<JsonReader> open = reader.at("open").items();
  if (open.size() != tally.open.size()) reader.fail_at("open", "another number of causes");
  for (std::size_t k = 0; k < open.size(); ++k) tally.open[k] = open[k].count();
  for (const JsonReader& run : reader.at("confirmed").items())
    tally.confirmed.push_back(run.count());
  if (reader.has("worst")) {
    const JsonReader worst = reader.at("worst");
    tally.worst = {worst.at("run").count(), judgement_from(worst.at("judgement")),
                   from_bits(worst.at("score")), termination_from(worst.at("termination"))};
  }
  if (tally.runs > 0 && !tally.worst) reader.fail("the key 'worst' is missing");
  read_firsts(reader, tally);
  for (const JsonReader& claim : reader.at("claims").items())
    tally.claims.push_back({claim.at("violations").count(), claim.at("undecided").count(),
                            claim.at("run").count(), finding_from(claim.at("worst")),
                            from_bits(claim.at("floor"))});
  for (const JsonReader& event : reader.at("happened").items())
    tally.happened.push_back(event.truth() ? 1 : 0);
  return tally;
}

}  // namespace

Json to_json(const verify::CampaignFacts& facts) {
  Json document = {{"runs", facts.asked},
                   {"seed", facts.seed},
                   {"confidence", bits(facts.confidence)},
                   {"horizon", bits(facts.horizon)},
                   {"many_at_once", facts.many_at_once}};
  if (facts.different) document["different_runs"] = *facts.different;
  document["events"] = facts.events;
  document["doubts"] = facts.doubts;
  document["claims"] = list(facts.claims, [](const verify::ClaimFacts& claim) -> Json {
    return {{"claim", claim.name},
            {"kind", to_string(claim.kind)},
            {"missing", claim.missing},
            {"growing", claim.growing}};
  });
  return document;
}

verify::CampaignFacts facts_from(const JsonReader& reader) {
  verify::CampaignFacts facts;
  facts.asked = reader.at("runs").count();
  facts.seed = reader.at("seed").count();
  facts.confidence = from_bits(reader.at("confidence"));
  facts.horizon = from_bits(reader.at("horizon"));
  facts.many_at_once = reader.at("many_at_once").truth();
  if (reader.has("different_runs")) facts.different = reader.at("different_runs").count();
  facts.events = texts_from(reader.at("events"));
  facts.doubts = texts_from(reader.at("doubts"));
  for (const JsonReader& claim : reader.at("claims").items())
    facts.claims.push_back({claim.at("claim").text(), kind_from(claim.at("kind")),
                            texts_from(claim.at("missing")), claim.at("growing").text()});
  return facts;
}

Json runs_json(const verify::CampaignPart& part) {
  Json document = {{"ranges", ranges_json(part.runs)}, {"tally", tally_json(part.tally)}};
  if (part.figures.runs.count() > 0) document["figures"] = to_json(part.figures);
  return document;
}

void read_runs(const JsonReader& reader, verify::CampaignPart& part) {
  part.runs = ranges_from(reader.at("ranges"));
  part.tally = tally_from(reader.at("tally"));
  std::size_t stated = 0;
  for (const verify::ClaimFacts& claim : part.facts.claims) stated += claim.stated() ? 1 : 0;
  const verify::Tally& tally = part.tally;
  if (tally.runs != part.runs.count()) reader.fail("another number of runs than the ranges have");
  if (tally.runs > 0 &&
      (tally.claims.size() != stated || tally.happened.size() != part.facts.events.size()))
    reader.fail("another number of claims or events than the campaign has");
  if (reader.has("figures")) part.figures = survey_from(reader.at("figures"));
}

Json repeats_json(const verify::CampaignPart& part) {
  return list(part.repeats, [](const auto& entry) {
    const auto& [run, repeat] = entry;
    Json document = {{"run", run}};
    if (const auto& careful = repeat.careful) {
      document["findings"] = list(careful->findings, finding_json);
      document["termination"] = to_string(careful->termination);
      document["message"] = careful->message;
    }
    if (repeat.confirmed) document["confirmed"] = *repeat.confirmed;
    return document;
  });
}

void read_repeats(const JsonReader& reader, verify::CampaignPart& part) {
  for (const JsonReader& item : reader.items()) {
    verify::Repeat& repeat = part.repeats[item.at("run").count()];
    if (item.has("findings"))
      repeat.careful = {findings_from(item.at("findings")),
                        termination_from(item.at("termination")), item.at("message").text()};
    if (item.has("confirmed")) repeat.confirmed = item.at("confirmed").truth();
  }
}

}  // namespace gainsmith::app
