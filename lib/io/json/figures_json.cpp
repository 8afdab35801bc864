#include "io/json/figures_json.h"

#include "io/json/json_fields.h"

namespace gainsmith::io {

namespace {

constexpr auto kQuantileFields = [](auto& at, auto& quantile) {
  at("probability", quantile.probability);
  at("value", quantile.value);
  at("low", quantile.low);
  at("high", quantile.high);
};

/// How well covariances fit errors.
constexpr auto kConsistencyFields = [](auto& at, auto& fit) {
  at("fit", fit.fit);
  at("squares", fit.squares);
  at("improper", fit.improper);
  at("mean", fit.mean);
  at("expected", fit.expected);
  at("low", fit.low);
  at("high", fit.high);
  at("probability", fit.probability);
};

constexpr auto kFigureFields = [](auto& at, auto& figure) {
  at("figure", figure.figure);
  at("observer", figure.observer);
  at("runs", figure.runs);
  at("runs_without", figure.without);
  // Keys that belong together: all of them are there, or none.
  const bool has_errors = at.has("error");
  if (has_errors) {
    at("runs_unknown", figure.unknown);
    at("why", figure.why);
    at("error", figure.error);
  }
  // A value, its numerical error, and the run that has it.
  const auto of_run = [&](const char* key, auto& value, auto& error, auto& run) {
    at.group(key, [&](auto& part) {
      part("value", value);
      if (has_errors) part("error", error);
      part("run", run);
    });
  };
  of_run("least", figure.least, figure.least_error, figure.least_run);
  of_run("largest", figure.largest, figure.largest_error, figure.largest_run);
  at("quantiles", figure.quantiles, kQuantileFields);
  at("resolution", figure.resolution);
  at.some("consistency", figure.consistency, kConsistencyFields);
};

constexpr auto kFiguresFields = [](auto& at, auto& record) {
  at("runs", record.runs);
  at("runs_asked", record.asked);
  at("seed", record.seed);
  at("confidence", record.confidence);
  at("figures", record.figures, kFigureFields);
};

}  // namespace

Json to_json(const model::FiguresRecord& record) {
  return record_json(record, kFiguresFields, JsonNumbers::or_text);
}

model::FiguresRecord figures_of(const JsonReader& reader) {
  model::FiguresRecord record;
  read_record(reader, record, kFiguresFields, JsonNumbers::or_text);
  return record;
}

}  // namespace gainsmith::io
