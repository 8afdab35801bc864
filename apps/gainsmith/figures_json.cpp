#include "gainsmith/figures_json.h"

#include <vector>

#include "io/json/json_fields.h"

namespace gainsmith::app {

namespace {

using io::Json;
using io::JsonReader;

constexpr auto kContentsFields = [](auto& at, auto& contents) {
  at("level", contents.level);
  at("count", contents.count);
  at("least", contents.least);
  at("largest", contents.largest);
  at("at", contents.at);
  at("counts", contents.counts);
};

Json sketch_json(const statistics::ValueSketch& sketch) {
  return io::record_json(sketch.contents(), kContentsFields, io::JsonNumbers::exact);
}

statistics::ValueSketch sketch_from(const JsonReader& reader) {
  statistics::ValueSketch::Contents contents;
  io::read_record(reader, contents, kContentsFields, io::JsonNumbers::exact);
  if (contents.at.size() != contents.counts.size()) reader.fail("another number of counts");
  return statistics::ValueSketch::of(contents);
}

constexpr auto kOfRunFields = [](auto& at, auto& of) {
  at("value", of.value);
  at("run", of.run);
  at("error", of.error);
};

constexpr auto kSomeRunsFields = [](auto& at, auto& some) {
  at("count", some.count);
  at("first", some.first);
  at("why", some.why);
};

constexpr auto kSquaresFields = [](auto& at, auto& squares) {
  at("elements", squares.elements);
  at("count", squares.count);
  statistics::ExactSum::Digits digits = squares.sum.digits();
  at("sum", digits);
  if constexpr (io::kReads<decltype(at)>) squares.sum = statistics::ExactSum::of(digits);
  at("improper", squares.improper);
};

constexpr auto kSummaryFields = [](auto& at, auto& figure) {
  at("title", figure.title);
  at("observer", figure.observer);
  at.as("values", figure.values, sketch_json, sketch_from);
  at("error", figure.error);
  at("without", figure.without);
  at("unknown", figure.unknown, kSomeRunsFields);
  at("least", figure.least, kOfRunFields);
  at("largest", figure.largest, kOfRunFields);
  at("whole", figure.whole);
  if (io::kReads<decltype(at)> ? at.has("squares") : figure.squares.elements > 0)
    at("squares", figure.squares, kSquaresFields);
};

constexpr auto kSurveyFields = [](auto& at, auto& figures) {
  at.as("ranges", figures.runs, ranges_json, ranges_from);
  at("runs", figures.survey.runs);
  at("early", figures.survey.early, kSomeRunsFields);
  at("figures", figures.survey.figures, kSummaryFields);
};

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
  return io::record_json(figures, kSurveyFields, io::JsonNumbers::exact);
}

statistics::SurveyOfRuns survey_from(const JsonReader& reader) {
  statistics::SurveyOfRuns figures;
  io::read_record(reader, figures, kSurveyFields, io::JsonNumbers::exact);
  return figures;
}

}  // namespace gainsmith::app
