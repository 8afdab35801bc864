#include "gainsmith/figures_json.h"

#include <bit>
#include <optional>
#include <vector>

#include "gainsmith/exact_number.h"

namespace gainsmith::app {

namespace {

using io::Json;
using io::JsonReader;

// Whole numbers with a sign are written by their bits: readers know counts.

template <class Numbers>
Json wholes_json(const Numbers& numbers) {
  Json list = Json::array();
  for (const auto number : numbers) list.push_back(std::bit_cast<std::uint64_t>(number));
  return list;
}

std::vector<std::int64_t> wholes_from(const JsonReader& reader) {
  std::vector<std::int64_t> numbers;
  for (const JsonReader& item : reader.items())
    numbers.push_back(std::bit_cast<std::int64_t>(item.count()));
  return numbers;
}

Json sketch_json(const statistics::ValueSketch& sketch) {
  const auto contents = sketch.contents();
  return {{"level", contents.level},        {"count", contents.count},
          {"least", bits(contents.least)},  {"largest", bits(contents.largest)},
          {"at", wholes_json(contents.at)}, {"counts", contents.counts}};
}

statistics::ValueSketch sketch_from(const JsonReader& reader) {
  statistics::ValueSketch::Contents contents;
  contents.level = reader.at("level").whole();
  contents.count = reader.at("count").count();
  contents.least = from_bits(reader.at("least"));
  contents.largest = from_bits(reader.at("largest"));
  contents.at = wholes_from(reader.at("at"));
  for (const JsonReader& item : reader.at("counts").items())
    contents.counts.push_back(item.count());
  if (contents.at.size() != contents.counts.size()) reader.fail("another number of counts");
  return statistics::ValueSketch::of(contents);
}

Json of_run_json(const std::optional<statistics::OfRun>& of) {
  return of ? Json{{"value", bits(of->value)}, {"run", of->run}, {"error", bits(of->error)}}
            : Json();
}

std::optional<statistics::OfRun> of_run_from(const JsonReader& reader) {
  if (reader.is_null()) return std::nullopt;
  return statistics::OfRun{from_bits(reader.at("value")), reader.at("run").count(),
                           from_bits(reader.at("error"))};
}

Json some_json(const statistics::SomeRuns& some) {
  return {{"count", some.count}, {"first", some.first}, {"why", some.why}};
}

statistics::SomeRuns some_from(const JsonReader& reader) {
  return {reader.at("count").count(), reader.at("first").count(), reader.at("why").text()};
}

Json squares_json(const statistics::SquaredErrors& squares) {
  return {{"elements", squares.elements},
          {"count", squares.count},
          {"sum", wholes_json(squares.sum.digits())},
          {"improper", squares.improper}};
}

statistics::SquaredErrors squares_from(const JsonReader& reader) {
  statistics::SquaredErrors squares;
  squares.elements = static_cast<std::int64_t>(reader.at("elements").count());
  squares.count = reader.at("count").count();
  const std::vector<std::int64_t> found = wholes_from(reader.at("sum"));
  statistics::ExactSum::Digits digits{};
  if (found.size() != digits.size()) reader.fail("another number of digits");
  for (std::size_t k = 0; k < digits.size(); ++k) digits[k] = found[k];
  squares.sum = statistics::ExactSum::of(digits);
  squares.improper = reader.at("improper").count();
  return squares;
}

Json summary_json(const statistics::FigureSummary& figure) {
  Json document = {{"title", figure.title},
                   {"observer", figure.observer},
                   {"values", sketch_json(figure.values)},
                   {"error", bits(figure.error)},
                   {"without", figure.without},
                   {"unknown", some_json(figure.unknown)},
                   {"least", of_run_json(figure.least)},
                   {"largest", of_run_json(figure.largest)},
                   {"whole", figure.whole}};
  if (figure.squares.elements > 0) document["squares"] = squares_json(figure.squares);
  return document;
}

statistics::FigureSummary summary_from(const JsonReader& reader) {
  statistics::FigureSummary figure;
  figure.title = reader.at("title").text();
  figure.observer = reader.at("observer").text();
  figure.values = sketch_from(reader.at("values"));
  figure.error = from_bits(reader.at("error"));
  figure.without = reader.at("without").count();
  figure.unknown = some_from(reader.at("unknown"));
  figure.least = of_run_from(reader.at("least"));
  figure.largest = of_run_from(reader.at("largest"));
  figure.whole = reader.at("whole").truth();
  if (reader.has("squares")) figure.squares = squares_from(reader.at("squares"));
  return figure;
}

}  // namespace

Json ranges_json(const statistics::RunSet& runs) {
  Json ranges = Json::array();
  for (const statistics::RunRange& range : runs.ranges())
    ranges.push_back(Json::array({range.first, range.last}));
  return ranges;
}

statistics::RunSet ranges_from(const JsonReader& reader) {
  statistics::RunSet runs;
  for (const JsonReader& range : reader.items()) {
    const std::vector<JsonReader> ends = range.items();
    if (ends.size() != 2) range.fail("expected the first run and the one behind the last");
    if (runs.add({ends[0].count(), ends[1].count()}).count() > 0)
      range.fail("these runs occur twice");
  }
  return runs;
}

Json to_json(const statistics::SurveyOfRuns& figures) {
  const statistics::FigureSurvey& survey = figures.survey;
  Json list = Json::array();
  for (const statistics::FigureSummary& figure : survey.figures)
    list.push_back(summary_json(figure));
  return {{"ranges", ranges_json(figures.runs)},
          {"runs", survey.runs},
          {"early", some_json(survey.early)},
          {"figures", list}};
}

statistics::SurveyOfRuns survey_from(const JsonReader& reader) {
  statistics::SurveyOfRuns figures;
  figures.runs = ranges_from(reader.at("ranges"));
  statistics::FigureSurvey& survey = figures.survey;
  survey.runs = reader.at("runs").count();
  survey.early = some_from(reader.at("early"));
  for (const JsonReader& figure : reader.at("figures").items())
    survey.figures.push_back(summary_from(figure));
  return figures;
}

}  // namespace gainsmith::app
