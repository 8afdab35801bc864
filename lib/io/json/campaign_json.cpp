#include "io/json/campaign_json.h"

#include "base/hash.h"
#include "io/json/figures_json.h"
#include "io/json/gains_json.h"
#include "io/json/json_fields.h"

namespace gainsmith::io {

namespace {

constexpr auto kWorstFields = [](auto& at, auto& worst) {
  at("score", worst.score);
  at("value", worst.value);
  at("bound", worst.bound);
  at("rounding", worst.rounding);
  at("t", worst.t);
  at("j", worst.j);
};

/// A claim: of one that is not stated what it lacks, of others the worst sample at (t, j).
constexpr auto kClaimFields = [](auto& at, auto& check) {
  at("claim", check.name);
  at("kind", check.kind);
  at("stated", check.stated);
  if (!check.stated) return at("missing", check.missing);
  at("looked_at", check.sampled);
  at("violations", check.violations);
  at("undecided", check.undecided);
  at("worst_run", check.worst_run);
  at("worst", check.worst, kWorstFields);
  at.some("tolerance", check.tolerance);
  at.some("checked_down_to", check.checked_down_to);
};

constexpr auto kOpenRunFields = [](auto& at, auto& open) {
  at("run", open.run);
  at("why", open.why);
};

constexpr auto kCampaignFields = [](auto& at, auto& record) {
  at("verdict", record.verdict);
  at("runs", record.runs);
  at("seed", record.seed);
  at("horizon", record.horizon);
  model::CampaignVerdict status = record.verdict;
  at("status", status);
  if constexpr (kReads<decltype(at)>)
    if (status != record.verdict) at.reader().at("status").fail("differs from the verdict");
  at("violations", record.violations);
  at("undecided", record.undecided);
  at("unfinished", record.unfinished);
  at("worst_run", record.worst_run);
  at("repeated", record.repeated);
  at("confirmed", record.confirmed);
  at("different_runs", record.different_runs);
  at("confidence", record.confidence);
  at("violation_probability_at_most", record.violation_probability);
  at("notes", record.notes);
  at("checks", record.checks, kClaimFields);
  at.some("first_unfinished", record.first_unfinished, kOpenRunFields);
  at.some("first_undecided", record.first_undecided, kOpenRunFields);
  at.some_but("runs_asked", record.runs_asked, record.runs);
  at.some("message", record.message);
  if (kReads<decltype(at)> ? at.has("figures") : record.figures.has_value())
    at.as(
        "figures", record.figures, [](const auto& figures) { return to_json(*figures); },
        figures_of);
  at("gainsmith", record.version);
  at("gains_sha256", record.gains_hash);
};

}  // namespace

Json to_json(const model::CampaignRecord& record) { return record_json(record, kCampaignFields); }

model::CampaignRecord parse_campaign(const std::string& text, const std::string& file) {
  const Json document = parse_json(text, file);
  const JsonReader reader(document, file, text);
  if (!reader.has("gainsmith"))
    reader.fail(
        "this is no campaign of 'gainsmith run' or 'gainsmith verify --json', or one of an "
        "earlier version: make it again");
  version_of(reader.at("gainsmith"));
  model::CampaignRecord record;
  read_record(reader, record, kCampaignFields);
  reader.finish();
  return record;
}

std::string gains_hash(const model::Gains& gains) {
  Json document = to_json(gains);
  document.erase("timings");
  return sha256(to_text(document));
}

}  // namespace gainsmith::io
