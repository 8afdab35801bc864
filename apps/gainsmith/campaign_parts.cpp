#include "gainsmith/campaign_parts.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "gainsmith/campaign_json.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/figures_text.h"
#include "gainsmith/terminal.h"
#include "io/json/campaign_json.h"
#include "verify/campaign.h"

namespace gainsmith::app {

namespace {

constexpr const char* kCompare = "compare";

std::string range_text(const statistics::RunRange& range) {
  if (range.count() == 1) return fmt::format("run {}", range.first);
  return fmt::format("runs {} to {}", range.first, range.last - 1);
}

PartFile part_from(const io::Json& document, const std::string& file) {
  const io::JsonReader reader(document, file);
  PartFile read;
  read.statement = document.at("statement");
  read.source = reader.at("source").text();
  read.shard = shard_of(document);
  read.part.facts = facts_from(reader.at("campaign"));
  read_runs(reader.at("runs"), read.part);
  read_repeats(reader.at("repeats"), read.part);
  return read;
}

/// Which file has some of these runs.
std::string owner_of(const statistics::RunRange& range,
                     const std::vector<std::pair<std::string, statistics::RunSet>>& known) {
  for (const auto& [file, runs] : known)
    if (statistics::RunSet copy = runs; copy.add(range).count() > 0) return file;
  return "?";
}

/// The parts of a campaign cut into as many as the first was that have these runs: "3/8, 5/8".
std::string shards_with(const std::vector<statistics::RunRange>& missing, const PartFile& whole) {
  constexpr int kMost = 5;
  std::string text;
  int found = 0;
  for (std::uint64_t k = 1; k <= whole.shard.of; ++k) {
    const statistics::RunRange shard =
        statistics::shard_of(whole.part.facts.asked, k, whole.shard.of);
    statistics::RunSet own;
    own.add(shard);
    bool lacks = false;
    for (const statistics::RunRange& range : missing)
      lacks = lacks || statistics::RunSet(own).add(range).count() > 0;
    if (!lacks) continue;
    if (++found > kMost) return text + ", ...";
    text += (found > 1 ? ", " : "") + to_text(Shard{k, whole.shard.of});
  }
  return text;
}

[[noreturn]] void refuse_twice(const std::string& file, const Shard& shard,
                               const statistics::RunRange& runs, const std::string& owner) {
  if (owner == file) throw InputError({file}, "this part is given twice");
  throw InputError({file}, fmt::format("{} of this part, {}, are in {} too; each run may be in one "
                                       "part only",
                                       range_text(runs), to_text(shard), owner));
}

/// `other_cut`: that some parts are of another number of parts; empty: none is.
void require_all_runs(const PartFile& whole, const std::string& other_cut) {
  const auto missing = whole.part.runs.missing_in({0, whole.part.facts.asked});
  if (missing.empty()) return;
  throw InputError(
      {}, fmt::format(
              "{} {} in no part{}; {}", range_text(missing.front()),
              missing.front().count() == 1 ? "is" : "are",
              missing.size() > 1 ? fmt::format(", nor {} other ranges", missing.size() - 1) : "",
              other_cut.empty() ? "make what is missing with --shard " + shards_with(missing, whole)
                                : other_cut + ": make all parts with one N in --shard I/N"));
}

/// Where nothing is drawn no run says anything of another.
std::optional<model::FiguresRecord> record_of_figures(const PartFile& whole) {
  if (!whole.statement.contains(kCompare)) return std::nullopt;
  const verify::CampaignFacts& facts = whole.part.facts;
  std::optional<double> confidence;
  if (!facts.different) confidence = facts.confidence;
  return figures_record(whole.part.figures.survey, facts.asked, facts.seed, confidence, confidence);
}

}  // namespace

io::Json campaign_statement(const verify::CampaignFacts& facts, const std::string& gains_hash,
                            bool compare) {
  io::Json statement = begin_statement("campaign");
  statement["gains_sha256"] = gains_hash;
  statement["seed"] = facts.seed;
  statement["runs"] = facts.asked;
  statement["confidence"] = facts.confidence;
  if (compare) statement[kCompare] = "yes";
  if (facts.until_violated) statement["until"] = "violated";
  return statement;
}

io::Json document_of(const PartFile& file) {
  io::Json document = part_head(PartKind::campaign, file.shard, file.statement);
  document["source"] = file.source;
  document["campaign"] = to_json(file.part.facts);
  document["runs"] = runs_json(file.part);
  document["repeats"] = repeats_json(file.part);
  return document;
}

PartFile merged_campaign(const std::vector<std::string>& files) {
  const io::Json first = read_part(files.front());
  PartFile whole = part_from(first, files.front());
  std::vector<std::pair<std::string, statistics::RunSet>> known{{files.front(), whole.part.runs}};
  std::string other_cut;
  for (std::size_t k = 1; k < files.size(); ++k) {
    const io::Json document = read_part(files[k]);
    require_same_work(document, files[k], first, files.front());
    const PartFile next = part_from(document, files[k]);
    const statistics::RunRange twice = add(next.part, whole.part);
    if (twice.count() > 0) refuse_twice(files[k], next.shard, twice, owner_of(twice, known));
    if (next.shard.of != whole.shard.of && other_cut.empty())
      other_cut = fmt::format("{} is one of {} parts, and {} one of {}", files[k], next.shard.of,
                              files.front(), whole.shard.of);
    known.emplace_back(files[k], next.part.runs);
  }
  require_all_runs(whole, other_cut);
  return whole;
}

ExitCode tell_campaign(const PartFile& whole, const std::string& output, bool json) {
  const verify::Report report = verify::conclude(whole.part);
  const auto figures = record_of_figures(whole);
  const Telling telling;
  model::CampaignRecord record = campaign_record(report, whole.statement.value("gains_sha256", ""));
  record.figures = figures;
  const std::string text = io::to_text(io::to_json(record));
  if (!output.empty() && output != "-") write_atomically(output, text);
  if (json || output == "-")
    fmt::print("{}", text);
  else
    fmt::print("{}{}", campaign_summary(report, whole.source),
               figures ? figures_text(*figures) : "");
  const ExitCode exit = campaign_exit(report.verdict);
  const bool lacks_figures = figures && figures->runs < report.asked;
  return exit == ExitCode::yes && lacks_figures ? ExitCode::undecided : exit;
}

void take_kept(const io::Json& kept, const std::string& file, verify::CampaignPart& part) {
  read_runs(io::JsonReader(kept, file), part);
}

}  // namespace gainsmith::app
