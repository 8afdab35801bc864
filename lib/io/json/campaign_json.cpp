// Campaigns as JSON: writer and reader of each record are beside each other.
#include "io/json/campaign_json.h"

#include "base/hash.h"
#include "io/json/figures_json.h"
#include "io/json/gains_json.h"
#include "io/json/json_reader.h"

namespace gainsmith::io {

namespace {

Json optional_json(const auto& value) { return value ? Json(*value) : Json(); }

/// A claim: of one that is not stated what it lacks, of others the worst sample at (t, j).
Json check_json(const model::ClaimRecord& check) {
  Json result = {{"claim", check.name}, {"kind", check.kind}, {"stated", check.stated}};
  if (!check.stated) {
    result["missing"] = check.missing;
    return result;
  }
  result["looked_at"] = check.sampled;
  result["violations"] = check.violations;
  result["undecided"] = check.undecided;
  result["worst_run"] = check.worst_run;
  result["worst"] = {{"score", optional_json(check.worst.score)},
                     {"value", optional_json(check.worst.value)},
                     {"bound", optional_json(check.worst.bound)},
                     {"rounding", optional_json(check.worst.rounding)},
                     {"t", check.worst.t},
                     {"j", check.worst.j}};
  if (check.tolerance > 0) result["tolerance"] = check.tolerance;
  if (check.checked_down_to > 0) result["checked_down_to"] = check.checked_down_to;
  return result;
}

std::optional<double> optional_number(const JsonReader& reader) {
  return reader.is_null() ? std::nullopt : std::optional(reader.number());
}

std::vector<std::string> texts(const JsonReader& reader) {
  std::vector<std::string> found;
  for (const JsonReader& item : reader.items()) found.push_back(item.text());
  return found;
}

model::ClaimRecord check_of(const JsonReader& reader) {
  model::ClaimRecord check;
  check.name = reader.at("claim").text();
  check.kind = reader.at("kind").text();
  check.stated = reader.at("stated").truth();
  if (!check.stated) {
    check.missing = texts(reader.at("missing"));
    return check;
  }
  check.sampled = reader.at("looked_at").truth();
  check.violations = reader.at("violations").count();
  check.undecided = reader.at("undecided").count();
  check.worst_run = reader.at("worst_run").count();
  const JsonReader worst = reader.at("worst");
  check.worst = {optional_number(worst.at("score")),
                 optional_number(worst.at("value")),
                 optional_number(worst.at("bound")),
                 optional_number(worst.at("rounding")),
                 worst.at("t").number(),
                 static_cast<std::int64_t>(worst.at("j").count())};
  if (reader.has("tolerance")) check.tolerance = reader.at("tolerance").number();
  if (reader.has("checked_down_to")) check.checked_down_to = reader.at("checked_down_to").number();
  return check;
}

model::CampaignVerdict campaign_verdict_of(const JsonReader& reader) {
  using model::CampaignVerdict;
  for (const auto verdict :
       {CampaignVerdict::held, CampaignVerdict::violated, CampaignVerdict::undecided})
    if (to_string(verdict) == reader.text()) return verdict;
  reader.fail("expected held, violated or undecided");
}

/// The first run of a kind and why it is open; none where the key is not there.
std::optional<model::OpenRunRecord> open_run(const JsonReader& reader, const char* key) {
  if (!reader.has(key)) return std::nullopt;
  const JsonReader run = reader.at(key);
  return model::OpenRunRecord{run.at("run").count(), run.at("why").text()};
}

}  // namespace

Json to_json(const model::CampaignRecord& record) {
  Json checks = Json::array();
  for (const model::ClaimRecord& check : record.checks) checks.push_back(check_json(check));
  Json document = {{"verdict", to_string(record.verdict)},
                   {"runs", record.runs},
                   {"seed", record.seed},
                   {"horizon", record.horizon},
                   {"status", to_string(record.verdict)},
                   {"violations", record.violations},
                   {"undecided", record.undecided},
                   {"unfinished", record.unfinished},
                   {"worst_run", record.worst_run},
                   {"repeated", record.repeated},
                   {"confirmed", record.confirmed},
                   {"different_runs", optional_json(record.different_runs)},
                   {"confidence", optional_json(record.confidence)},
                   {"violation_probability_at_most", optional_json(record.violation_probability)},
                   {"notes", record.notes},
                   {"checks", checks}};
  for (const auto& [key, open] : {std::pair("first_unfinished", record.first_unfinished),
                                  std::pair("first_undecided", record.first_undecided)})
    if (open) document[key] = {{"run", open->run}, {"why", open->why}};
  if (record.runs < record.runs_asked) {
    document["runs_asked"] = record.runs_asked;
    document["message"] = record.message;
  }
  if (record.figures) document["figures"] = to_json(*record.figures);
  document["gainsmith"] = record.version;
  document["gains_sha256"] = record.gains_hash;
  return document;
}

model::CampaignRecord parse_campaign(const std::string& text, const std::string& file) {
  const Json document = parse_json(text, file);
  const JsonReader reader(document, file, text);
  model::CampaignRecord record;
  if (!reader.has("gainsmith"))
    reader.fail(
        "this is no campaign of 'gainsmith run' or 'gainsmith verify --json', or one of an "
        "earlier version: make it again");
  record.version = version_of(reader.at("gainsmith"));
  record.verdict = campaign_verdict_of(reader.at("verdict"));
  record.runs = reader.at("runs").count();
  record.seed = reader.at("seed").count();
  record.horizon = reader.at("horizon").number();
  if (reader.at("status").text() != to_string(record.verdict))
    reader.at("status").fail("differs from the verdict");
  record.violations = reader.at("violations").count();
  record.undecided = reader.at("undecided").count();
  record.unfinished = reader.at("unfinished").count();
  record.worst_run = reader.at("worst_run").count();
  record.repeated = reader.at("repeated").count();
  for (const JsonReader& run : reader.at("confirmed").items())
    record.confirmed.push_back(run.count());
  if (const JsonReader different = reader.at("different_runs"); !different.is_null())
    record.different_runs = different.count();
  record.confidence = optional_number(reader.at("confidence"));
  record.violation_probability = optional_number(reader.at("violation_probability_at_most"));
  record.notes = texts(reader.at("notes"));
  for (const JsonReader& check : reader.at("checks").items())
    record.checks.push_back(check_of(check));
  if (reader.has("figures")) record.figures = figures_of(reader.at("figures"));
  record.first_unfinished = open_run(reader, "first_unfinished");
  record.first_undecided = open_run(reader, "first_undecided");
  record.runs_asked = reader.has("runs_asked") ? reader.at("runs_asked").count() : record.runs;
  if (reader.has("message")) record.message = reader.at("message").text();
  record.gains_hash = reader.at("gains_sha256").text();
  reader.finish();
  return record;
}

std::string gains_hash(const model::Gains& gains) {
  Json document = to_json(gains);
  document.erase("timings");
  return sha256(to_text(document));
}

}  // namespace gainsmith::io
