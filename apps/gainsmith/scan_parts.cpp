#include "gainsmith/scan_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "gainsmith/exact_number.h"
#include "io/json/json_reader.h"

namespace gainsmith::app {

namespace {

io::Json scan_facts_json(const ScanFacts& facts) {
  io::Json axes = io::Json::array();
  for (const ScanFacts::Axis& axis : facts.axes) {
    io::Json values = io::Json::array();
    for (const double value : axis.values) values.push_back(bits(value));
    axes.push_back({{"name", axis.name},
                    {"title", axis.title},
                    {"values", values},
                    {"logarithmic", axis.logarithmic}});
  }
  return {{"title", facts.title},     {"axes", axes},           {"objective", facts.objective},
          {"figures", facts.figures}, {"titles", facts.titles}, {"note", facts.note}};
}

std::vector<std::string> list_of_texts(const io::JsonReader& reader) {
  std::vector<std::string> texts;
  for (const io::JsonReader& item : reader.items()) texts.push_back(item.text());
  return texts;
}

ScanFacts scan_facts_from(const io::JsonReader& reader) {
  ScanFacts facts;
  facts.title = reader.at("title").text();
  for (const io::JsonReader& item : reader.at("axes").items()) {
    ScanFacts::Axis& axis = facts.axes.emplace_back();
    axis.name = item.at("name").text();
    axis.title = item.at("title").text();
    for (const io::JsonReader& value : item.at("values").items())
      axis.values.push_back(from_bits(value));
    axis.logarithmic = item.at("logarithmic").truth();
  }
  facts.objective = reader.at("objective").text();
  facts.figures = list_of_texts(reader.at("figures"));
  facts.titles = list_of_texts(reader.at("titles"));
  facts.note = reader.at("note").text();
  return facts;
}

io::Json row_json(std::size_t point, const design::ScanRow& row) {
  io::Json document = {{"point", point}};
  if (!row.refused.empty()) {
    document["refused"] = row.refused;
    return document;
  }
  document["verdict"] = to_string(row.verdict);
  if (row.objective) document["objective"] = bits(*row.objective);
  io::Json figures = io::Json::array();
  for (const auto& figure : row.figures) figures.push_back(figure ? bits(*figure) : io::Json());
  document["figures"] = figures;
  return document;
}

model::Verdict verdict_from(const io::JsonReader& reader) {
  using enum model::Verdict;
  for (const model::Verdict verdict : {yes, no, undecided})
    if (to_string(verdict) == reader.text()) return verdict;
  reader.fail("expected yes, no or undecided");
}

void take_row(const io::JsonReader& reader, design::ScanRow& row) {
  row.interrupted = false;
  if (reader.has("refused")) {
    row.refused = reader.at("refused").text();
    return;
  }
  row.verdict = verdict_from(reader.at("verdict"));
  if (reader.has("objective")) row.objective = from_bits(reader.at("objective"));
  for (const io::JsonReader& figure : reader.at("figures").items())
    row.figures.push_back(figure.is_null() ? std::nullopt : std::optional(from_bits(figure)));
}

ScanPart scan_from(const io::Json& document, const std::string& file) {
  ScanPart part;
  part.statement = document.at("statement");
  part.shard = shard_of(document);
  part.facts = scan_facts_from(io::JsonReader(document, file).at("scan"));
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
    if (!part.rows[k].interrupted) rows.push_back(row_json(k, part.rows[k]));
  return rows;
}

void take_rows(const io::Json& rows, const std::string& file, ScanPart& part) {
  for (const io::JsonReader& reader : io::JsonReader(rows, file).items()) {
    const std::uint64_t point = reader.at("point").count();
    if (point >= part.rows.size()) reader.fail("the scan has no such point");
    if (!part.rows[point].interrupted)
      throw InputError({file}, fmt::format("point {} of this part is in another one too", point));
    take_row(reader, part.rows[point]);
  }
}

io::Json document_of(const ScanPart& part) {
  io::Json document = part_head(PartKind::scan, part.shard, part.statement);
  document["scan"] = scan_facts_json(part.facts);
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
