#include "gainsmith/figures_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/known_digits.h"
#include "base/number.h"
#include "statistics/quantiles.h"

namespace gainsmith::app {

namespace {

constexpr double kMedian = 0.5;

using Cells = std::vector<std::string>;

std::string cell(const std::optional<double>& value, double error) {
  constexpr int kDigits = 6;
  return value ? brief(*value, kDigits, error) : "-";
}

/// Of one run, where its number is not known.
const std::string kUnknown = "unknown";
constexpr const char* kNoValue =
    "no such event in this run, a time after its end, or a value that is no number";

/// Columns as wide as they need: the first `left` are names, the others end in line.
std::string table_text(const std::vector<Cells>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Cells& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const Cells& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k)
      line += k < left ? fmt::format("{:<{}}", row[k], widths[k] + (widths[k] > 0 ? 2 : 0))
                       : fmt::format("{:>{}}", row[k], widths[k] + 2);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

constexpr std::size_t kColumn = 13;

/// Of a column of values, which is as wide at the least.
std::string head(const std::string& name, std::size_t width = kColumn) {
  return fmt::format("{:>{}}", name, width);
}

/// The title where it is not that of the row above, and the observer.
Cells names_of(const std::vector<model::FigureRecord>& figures, std::size_t k) {
  const bool same = k > 0 && figures[k - 1].figure == figures[k].figure;
  return {same ? "" : figures[k].figure, figures[k].observer};
}

/// "1.2 to 1.3"; of too few runs "above 1.2".
std::string interval_text(const model::QuantileRecord& quantile, double error) {
  const auto end = [&](double value) { return brief(value, 4, error); };
  if (quantile.low && quantile.high) return end(*quantile.low) + " to " + end(*quantile.high);
  if (quantile.low) return "above " + end(*quantile.low);
  return quantile.high ? "below " + end(*quantile.high) : "-";
}

std::string run_text(std::uint64_t run) { return "run " + std::to_string(run); }

std::string quantiles_table(const model::FiguresRecord& record) {
  std::vector<Cells> rows = {{"", "", "least"}};
  for (const model::QuantileRecord& quantile : record.figures.front().quantiles)
    rows.front().push_back(
        quantile.probability == kMedian ? "median" : brief(100 * quantile.probability) + " %");
  rows.front().emplace_back("largest");
  for (std::size_t k = 0; k < record.figures.size(); ++k) {
    const model::FigureRecord& figure = record.figures[k];
    Cells values = names_of(record.figures, k);
    Cells below = {"", "", run_text(figure.least_run)};
    values.push_back(cell(figure.least, figure.least_error));
    for (const model::QuantileRecord& quantile : figure.quantiles) {
      values.push_back(cell(quantile.value, figure.error));
      below.push_back(record.confidence ? interval_text(quantile, figure.error) : "");
    }
    values.push_back(cell(figure.largest, figure.largest_error));
    below.push_back(run_text(figure.largest_run));
    rows.push_back(values);
    if (figure.runs > 0) rows.push_back(below);
  }
  return table_text(rows, 2);
}

std::optional<double> median_of(const model::FigureRecord& figure) {
  for (const model::QuantileRecord& quantile : figure.quantiles)
    if (quantile.probability == kMedian) return quantile.value;
  return std::nullopt;
}

std::string spread_table(const std::vector<model::FigureRecord>& figures) {
  std::vector<Cells> rows = {
      {"", "", head("least"), "run", head("median"), head("largest"), "run"}};
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const model::FigureRecord& figure = figures[k];
    rows.push_back(names_of(figures, k));
    const auto run = [&](std::uint64_t of) { return figure.runs > 0 ? std::to_string(of) : "-"; };
    for (const std::string& text :
         {cell(figure.least, figure.least_error), run(figure.least_run),
          cell(median_of(figure), figure.error), cell(figure.largest, figure.largest_error),
          run(figure.largest_run)})
      rows.back().push_back(text);
  }
  return table_text(rows, 2);
}

/// Of one run: a column for each observer.
std::string comparison_table(const std::vector<model::FigureRecord>& figures) {
  std::vector<std::string> observers, titles;
  const auto add = [](std::vector<std::string>& list, const std::string& one) {
    if (std::find(list.begin(), list.end(), one) == list.end()) list.push_back(one);
  };
  for (const model::FigureRecord& figure : figures) {
    add(observers, figure.observer);
    add(titles, figure.figure);
  }
  std::vector<Cells> rows = {{""}};
  std::size_t column = kColumn;  // all are as wide
  for (const std::string& observer : observers) column = std::max(column, observer.size());
  for (const std::string& observer : observers)
    rows.front().push_back(head(observer.empty() ? "all" : observer, column));
  bool has_all = true;
  for (const std::string& title : titles) {
    rows.push_back({title});
    for (const std::string& observer : observers) {
      const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& one) {
        return one.figure == title && one.observer == observer;
      });
      const bool none = found == figures.end();
      const bool unknown = !none && found->unknown > 0;
      rows.back().push_back(none      ? "-"
                            : unknown ? kUnknown
                                      : cell(found->least, found->least_error));
      has_all = has_all && (none || unknown || found->least);
    }
  }
  return table_text(rows, 1) + (has_all ? "" : fmt::format("-: {}\n", kNoValue));
}

/// Of each figure that is not known of all runs.
std::string unknown_text(const model::FiguresRecord& record) {
  std::string text;
  for (const model::FigureRecord& figure : record.figures)
    if (figure.unknown > 0)
      text += fmt::format("{}: {}: {}\n", title_of(figure),
                          record.runs == 1 ? kUnknown
                                           : fmt::format("not known in {} of {} runs, as",
                                                         figure.unknown, record.runs),
                          figure.why);
  return text;
}

/// Of each figure that not all runs have.
std::string missing_text(const std::vector<model::FigureRecord>& figures) {
  std::string text;
  for (const model::FigureRecord& figure : figures)
    if (figure.without > 0)
      text += fmt::format("{}: no value in {} of {} runs: {}\n", title_of(figure), figure.without,
                          figure.runs + figure.without + figure.unknown, kNoValue);
  return text;
}

std::string fit_text(const model::ConsistencyRecord& fit) {
  std::string text = fit.fit;
  if (fit.improper > 0)
    text += fmt::format(
        ", as {} of {} values are negative, infinite or no numbers: the covariance is not positive "
        "definite there",
        fit.improper, fit.improper + fit.squares);
  if (!fit.mean || !fit.low || !fit.high) return text;
  return text +
         fmt::format(", mean {} of {}; {} is expected, {} to {} of {} % of consistent filters",
                     brief(*fit.mean, 4), fit.squares, fit.expected, brief(*fit.low, 4),
                     brief(*fit.high, 4), brief(100 * fit.probability));
}

std::string consistency_text(const std::vector<model::FigureRecord>& figures) {
  std::string text;
  for (const model::FigureRecord& figure : figures)
    if (figure.consistency) text += title_of(figure) + ": " + fit_text(*figure.consistency) + "\n";
  return text;
}

std::string resolution_text(const std::vector<model::FigureRecord>& figures) {
  double coarsest = 0;
  for (const model::FigureRecord& figure : figures)
    coarsest = std::max(coarsest, figure.resolution);
  return coarsest > 0 ? fmt::format("quantiles are computed to {} %\n", brief(100 * coarsest, 2))
                      : "";
}

model::FigureRecord figure_record(const statistics::FigureSummary& summary,
                                  std::optional<double> confidence, std::optional<double> fit) {
  model::FigureRecord record;
  record.figure = summary.title;
  record.observer = summary.observer;
  record.runs = summary.values.count();
  record.without = summary.without;
  record.unknown = summary.unknown.count;
  record.why = summary.unknown.why;
  record.error = summary.error;
  if (summary.least) {
    record.least = summary.least->value;
    record.least_run = summary.least->run;
    record.least_error = summary.least->error;
    record.largest = summary.largest->value;
    record.largest_run = summary.largest->run;
    record.largest_error = summary.largest->error;
  }
  for (const double probability : {0.05, kMedian, 0.95}) {
    const statistics::Quantile quantile = statistics::quantile_of(
        summary.values, probability, confidence.value_or(kMedian), summary.unknown.count);
    record.quantiles.push_back({probability, quantile.value, {}, {}});
    if (!confidence) continue;
    record.quantiles.back().low = quantile.low;
    record.quantiles.back().high = quantile.high;
  }
  record.resolution = summary.values.resolution();
  if (!fit || summary.squares.count + summary.squares.improper == 0) return record;
  const statistics::Consistency found = statistics::consistency_of(summary.squares, *fit);
  record.consistency = {to_string(found.fit),
                        summary.squares.count,
                        summary.squares.improper,
                        found.mean,
                        static_cast<std::uint64_t>(summary.squares.elements),
                        found.low,
                        found.high,
                        found.probability};
  return record;
}

}  // namespace

std::string title_of(const model::FigureRecord& figure) {
  return (figure.observer.empty() ? "" : figure.observer + ": ") + figure.figure;
}

model::FiguresRecord figures_record(const statistics::FigureSurvey& survey, std::uint64_t asked,
                                    std::uint64_t seed, std::optional<double> confidence,
                                    std::optional<double> fit) {
  model::FiguresRecord record{survey.runs, asked, seed, confidence, {}};
  for (const statistics::FigureSummary& summary : survey.figures)
    record.figures.push_back(figure_record(summary, confidence, fit));
  return record;
}

std::string figures_text(const model::FiguresRecord& record) {
  std::string text = "figures     of ";
  text += record.runs < record.asked ? fmt::format("{} of {} runs", record.runs, record.asked)
          : record.runs == 1         ? "1 run"
                                     : fmt::format("{} runs", record.runs);
  if (record.runs == 0) return text + "\n";
  if (record.confidence)
    text += fmt::format(", quantiles with {} % confidence", brief(100 * *record.confidence));
  const std::string lines = record.runs == 1
                                ? comparison_text(record)
                                : quantiles_table(record) + missing_text(record.figures) +
                                      unknown_text(record) + consistency_text(record.figures) +
                                      resolution_text(record.figures);
  text += "\n  ";
  for (const char c : lines) text += c == '\n' ? std::string("\n  ") : std::string(1, c);
  text.resize(text.size() - 2);
  return text;
}

std::string comparison_text(const model::FiguresRecord& record) {
  const std::vector<model::FigureRecord>& figures = record.figures;
  const std::string fit = consistency_text(figures);
  const std::string unknown = unknown_text(record);
  if (record.runs == 1) return comparison_table(figures) + unknown + fit;
  return spread_table(figures) + missing_text(figures) + unknown + fit + resolution_text(figures);
}

}  // namespace gainsmith::app
