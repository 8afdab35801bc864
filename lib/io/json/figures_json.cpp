// Figures over runs as JSON: extremes with the runs that have them, quantiles with bounds of
// confidence, and how well covariances fit errors.
#include "io/json/figures_json.h"

#include <cmath>
#include <limits>

#include "base/number.h"

namespace gainsmith::io {

namespace {

Json value_json(const std::optional<double>& value) {
  if (!value) return {};
  return std::isinf(*value) ? Json(decimal17(*value)) : Json(*value);
}

std::optional<double> value_of(const JsonReader& reader) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (reader.is_null()) return std::nullopt;
  if (!reader.is_text()) return reader.number();
  if (reader.text() == "inf") return kInfinity;
  if (reader.text() == "-inf") return -kInfinity;
  reader.fail("expected a number, null, \"inf\" or \"-inf\"");
}

/// A value, its numerical error, and the run that has it.
Json of_run_json(const std::optional<double>& value, double error, std::uint64_t run) {
  return {{"value", value_json(value)}, {"error", error}, {"run", run}};
}

Json figure_json(const model::FigureRecord& figure) {
  Json result = {
      {"figure", figure.figure},
      {"observer", figure.observer},
      {"runs", figure.runs},
      {"runs_without", figure.without},
      {"runs_unknown", figure.unknown},
      {"why", figure.why},
      {"error", figure.error},
      {"least", of_run_json(figure.least, figure.least_error, figure.least_run)},
      {"largest", of_run_json(figure.largest, figure.largest_error, figure.largest_run)}};
  Json quantiles = Json::array();
  for (const model::QuantileRecord& quantile : figure.quantiles)
    quantiles.push_back({{"probability", quantile.probability},
                         {"value", value_json(quantile.value)},
                         {"low", value_json(quantile.low)},
                         {"high", value_json(quantile.high)}});
  result["quantiles"] = quantiles;
  result["resolution"] = figure.resolution;
  if (const auto& fit = figure.consistency)
    result["consistency"] = {{"fit", fit->fit},
                             {"squares", fit->squares},
                             {"improper", fit->improper},
                             {"mean", value_json(fit->mean)},
                             {"expected", fit->expected},
                             {"low", value_json(fit->low)},
                             {"high", value_json(fit->high)},
                             {"probability", fit->probability}};
  return result;
}

model::FigureRecord figure_of(const JsonReader& reader) {
  model::FigureRecord figure;
  figure.figure = reader.at("figure").text();
  figure.observer = reader.at("observer").text();
  figure.runs = reader.at("runs").count();
  figure.without = reader.at("runs_without").count();
  const JsonReader least = reader.at("least"), largest = reader.at("largest");
  // Keys that belong together: all of them are there, or none.
  if (reader.has("error")) {
    figure.unknown = reader.at("runs_unknown").count();
    figure.why = reader.at("why").text();
    figure.error = reader.at("error").number();
    figure.least_error = least.at("error").number();
    figure.largest_error = largest.at("error").number();
  }
  figure.least = value_of(least.at("value"));
  figure.least_run = least.at("run").count();
  figure.largest = value_of(largest.at("value"));
  figure.largest_run = largest.at("run").count();
  for (const JsonReader& quantile : reader.at("quantiles").items())
    figure.quantiles.push_back({quantile.at("probability").number(), value_of(quantile.at("value")),
                                value_of(quantile.at("low")), value_of(quantile.at("high"))});
  figure.resolution = reader.at("resolution").number();
  if (!reader.has("consistency")) return figure;
  const JsonReader fit = reader.at("consistency");
  figure.consistency = {fit.at("fit").text(),       fit.at("squares").count(),
                        fit.at("improper").count(), value_of(fit.at("mean")),
                        fit.at("expected").count(), value_of(fit.at("low")),
                        value_of(fit.at("high")),   fit.at("probability").number()};
  return figure;
}

}  // namespace

Json to_json(const model::FiguresRecord& record) {
  Json figures = Json::array();
  for (const model::FigureRecord& figure : record.figures) figures.push_back(figure_json(figure));
  return {{"runs", record.runs},
          {"runs_asked", record.asked},
          {"seed", record.seed},
          {"confidence", record.confidence ? Json(*record.confidence) : Json()},
          {"figures", figures}};
}

model::FiguresRecord figures_of(const JsonReader& reader) {
  model::FiguresRecord record;
  record.runs = reader.at("runs").count();
  record.asked = reader.at("runs_asked").count();
  record.seed = reader.at("seed").count();
  const JsonReader confidence = reader.at("confidence");
  if (!confidence.is_null()) record.confidence = confidence.number();
  for (const JsonReader& figure : reader.at("figures").items())
    record.figures.push_back(figure_of(figure));
  return record;
}

}  // namespace gainsmith::io
