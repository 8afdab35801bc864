#include "gainsmith/scan_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "io/json/json_fields.h"

namespace gainsmith::app {

namespace {

constexpr auto kAxisFields = [](auto& at, auto& axis) {
  at("name", axis.name);
  at("title", axis.title);
  at("values", axis.values);
  at("logarithmic", axis.logarithmic);
};

constexpr auto kScanFactsFields = [](auto& at, auto& facts) {
  at("title", facts.title);
  at("axes", facts.axes, kAxisFields);
  at("objective", facts.objective);
  at("figures", facts.figures);
  at("titles", facts.titles);
  at("note", facts.note);
};

/// The row of a point: why it was refused, or its answer.
constexpr auto kRowFields = [](auto& at, auto& row) {
  at.some("refused", row.refused);
  if (!row.refused.empty()) return;
  at("verdict", row.verdict);
  at.some("objective", row.objective);
  at("figures", row.figures);
};

ScanPart scan_from(const io::Json& document, const std::string& file) {
  ScanPart part;
  part.statement = document.at("statement");
  part.shard = shard_of(document);
  io::read_record(io::JsonReader(document, file).at("scan"), part.facts, kScanFactsFields,
                  io::JsonNumbers::exact);
  part.rows = design::rows_of(points_of(part.facts));
  return part;
}

void require_all_points(const ScanPart& whole) {
  std::set<std::uint64_t> shards;
  std::size_t open = 0;
  for (std::size_t k = 0; k < whole.rows.size(); ++k) {
    if (!whole.rows[k].interrupted) continue;
    ++open;
    shards.insert(k % whole.shard.of + 1);
  }
  if (open == 0) return;
  constexpr std::size_t kMost = 5;
  std::string text;
  std::size_t named = 0;
  for (const std::uint64_t shard : shards) {
    if (named == kMost) text += ", ...";
    if (named++ >= kMost) break;
    text += (text.empty() ? "" : ", ") + to_text(Shard{shard, whole.shard.of});
  }
  throw InputError({}, fmt::format("{} of {} points are in no part; make what is missing with "
                                   "--shard {}",
                                   open, whole.rows.size(), text));
}

}  // namespace

std::vector<std::size_t> points_of_shard(const ScanPart& part) {
  std::vector<std::size_t> points;
  for (std::size_t k = part.shard.index - 1; k < part.rows.size(); k += part.shard.of)
    points.push_back(k);
  return points;
}

std::size_t open_points(const ScanPart& part) {
  const std::vector<std::size_t> points = points_of_shard(part);
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(),
                    [&](std::size_t point) { return part.rows[point].interrupted; }));
}

io::Json rows_json(const ScanPart& part) {
  io::Json rows = io::Json::array();
  for (std::size_t k = 0; k < part.rows.size(); ++k)
    if (!part.rows[k].interrupted) {
      rows.push_back({{"point", k}});
      rows.back().update(io::record_json(part.rows[k], kRowFields, io::JsonNumbers::exact));
    }
  return rows;
}

void take_rows(const io::Json& rows, const std::string& file, ScanPart& part) {
  for (const io::JsonReader& reader : io::JsonReader(rows, file).items()) {
    const std::uint64_t point = reader.at("point").count();
    if (point >= part.rows.size()) reader.fail("the scan has no such point");
    if (!part.rows[point].interrupted)
      throw InputError({file}, fmt::format("point {} of this part is in another one too", point));
    part.rows[point].interrupted = false;
    io::read_record(reader, part.rows[point], kRowFields, io::JsonNumbers::exact);
  }
}

io::Json document_of(const ScanPart& part) {
  io::Json document = part_head(PartKind::scan, part.shard, part.statement);
  document["scan"] = io::record_json(part.facts, kScanFactsFields, io::JsonNumbers::exact);
  document["rows"] = rows_json(part);
  return document;
}

ScanPart merged_scan(const std::vector<std::string>& files) {
  const io::Json first = read_part(files.front());
  ScanPart whole = scan_from(first, files.front());
  std::map<std::uint64_t, std::string> known;
  for (const std::string& file : files) {
    const io::Json document = read_part(file);
    require_same_work(document, file, first, files.front());
    const Shard shard = shard_of(document);
    if (shard.of != whole.shard.of)
      throw InputError({file},
                       fmt::format("this is one of {} parts, and {} one of {}: all parts need "
                                   "one N in --shard I/N",
                                   shard.of, files.front(), whole.shard.of));
    if (const auto [at, added] = known.emplace(shard.index, file); !added)
      throw InputError({file}, at->second == file ? "this part is given twice"
                                                  : fmt::format("this is part {}, and so is {}",
                                                                to_text(shard), at->second));
    take_rows(document.at("rows"), file, whole);
  }
  require_all_points(whole);
  return whole;
}

}  // namespace gainsmith::app
