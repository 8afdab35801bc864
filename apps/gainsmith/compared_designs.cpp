#include "gainsmith/compared_designs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>

#include "base/number.h"
#include "gainsmith/load.h"
#include "gainsmith/several_designs.h"
#include "gainsmith/system_figures.h"
#include "model/words.h"
#include "statistics/figure_survey.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;
using page::Results;

/// "[1, 2; 3, 4]"; of a large one its size and norm.
std::string matrix_text(const numbers::Matrix& matrix) {
  constexpr Eigen::Index kMost = 12;
  if (matrix.size() == 1) return brief(matrix(0, 0));
  if (matrix.size() > kMost)
    return fmt::format("{} x {}, norm {}", matrix.rows(), matrix.cols(), brief(matrix.norm()));
  std::string text = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += (j > 0 ? ", " : i > 0 ? "; " : "") + brief(matrix(i, j));
  return text + "]";
}

class Table {
 public:
  explicit Table(std::size_t designs) : designs_(designs) {}

  /// A row of texts; `difference` where there are two numbers.
  void add(const std::string& what, std::vector<std::string> values, std::string difference = "") {
    if (std::ranges::all_of(values, [](const std::string& text) { return text.empty(); })) return;
    values.resize(designs_, "");
    values.push_back(std::move(difference));
    rows_.push_back({what, std::move(values)});
  }
  /// By design; what is missing stays empty.
  void add(const std::string& what, const std::vector<const numbers::Matrix*>& values) {
    std::vector<std::string> texts;
    for (const numbers::Matrix* value : values)
      texts.push_back(value == nullptr ? "" : matrix_text(*value));
    add(what, texts, difference_of(values));
  }
  std::vector<page::Comparison::Row> take() { return std::move(rows_); }

 private:
  static std::string difference_of(const std::vector<const numbers::Matrix*>& values) {
    if (values.size() != 2 || values[0] == nullptr || values[1] == nullptr) return "";
    const numbers::Matrix &a = *values[0], &b = *values[1];
    if (a.rows() != b.rows() || a.cols() != b.cols()) return "other sizes";
    if (a.size() == 1) return brief(b(0, 0) - a(0, 0));
    return a.size() == 0 ? "" : "at most " + brief((b - a).cwiseAbs().maxCoeff());
  }

  std::size_t designs_;
  std::vector<page::Comparison::Row> rows_;
};

/// A row for each name that one of the designs has, in the order in which they come.
void add_matrices(const std::vector<Results>& all, const std::string& prefix,
                  model::NamedMatrices model::Gains::*list, Table& table) {
  std::vector<std::string> names;
  for (const Results& results : all)
    for (const auto& [name, value] : results.gains.*list)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  for (const std::string& name : names) {
    std::vector<const numbers::Matrix*> values;
    for (const Results& results : all) {
      const auto found = std::ranges::find_if(
          results.gains.*list, [&](const auto& entry) { return entry.first == name; });
      values.push_back(found == (results.gains.*list).end() ? nullptr : &found->second);
    }
    table.add(prefix + name, values);
  }
}

void add_numbers(const std::vector<SystemNumber>& all, std::size_t designs, Table& table) {
  std::set<std::string> done;
  for (const SystemNumber& first : all) {
    if (!done.insert(first.what).second) continue;
    std::vector<numbers::Matrix> values(designs);
    std::vector<const numbers::Matrix*> known(designs, nullptr);
    for (const SystemNumber& number : all)
      if (number.what == first.what) {
        values[number.design] = numbers::Matrix::Constant(1, 1, number.value);
        known[number.design] = &values[number.design];
      }
    table.add(first.what, known);
  }
}

void add_campaigns(const std::vector<Results>& all, Table& table) {
  std::vector<std::string> lines;
  for (const Results& results : all) lines.push_back(results.campaign_line);
  if (std::ranges::any_of(lines, [](const std::string& line) { return !line.empty(); }))
    table.add("campaign", lines);
}

/// Data and parameters that are not the same in all.
void add_data(const std::vector<NamedDesign>& designs, Table& table) {
  std::vector<std::string> names;
  for (const NamedDesign& design : designs)
    for (const auto* list :
         {&design.loaded.stated.design->data, &design.loaded.stated.design->parameters})
      for (const model::Design::Datum& datum : *list)
        if (std::ranges::find(names, datum.name) == names.end()) names.push_back(datum.name);
  for (const std::string& name : names) {
    std::vector<const numbers::Matrix*> values;
    for (const NamedDesign& design : designs) {
      const auto found = design.loaded.stated.values.find(name);
      values.push_back(found == design.loaded.stated.values.end() ? nullptr : &found->second);
    }
    const numbers::Matrix* first = values.front();
    const bool same = std::ranges::all_of(values, [&](const numbers::Matrix* matrix) {
      return first != nullptr && matrix != nullptr && matrix->rows() == first->rows() &&
             matrix->cols() == first->cols() && *matrix == *first;
    });
    if (!same) table.add(name, values);
  }
}

/// "gains.json" of a folder of one problem.
std::string gain_file_of(const std::string& path) {
  std::error_code none;
  return fs::is_directory(path, none) ? (fs::path(path) / "gains.json").string() : path;
}

/// Run 0 of each, whose figures become rows.
page::SystemFigure runs_of(const std::vector<NamedDesign>& designs,
                           const std::vector<std::string>& files, Table& table) {
  std::vector<LoadedGains> loaded;
  for (const NamedDesign& design : designs) loaded.push_back(design.loaded);
  for (std::size_t k = 0; k < loaded.size(); ++k)
    refuse_without_campaign(*loaded[k].stated.design, files[k]);
  require_same_plant(loaded, files);
  const std::uint64_t seed = loaded.front().stated.design->campaign.seed;
  std::vector<std::unique_ptr<const verify::Setup>> setups;
  std::vector<DesignRun> runs;
  std::vector<SystemNumber> numbers;
  for (std::size_t k = 0; k < designs.size(); ++k) {
    const model::Design& design = *loaded[k].stated.design;
    setups.push_back(verify::make_setup(loaded[k].stated, loaded[k].gains));
    const verify::Setup& setup = *setups.back();
    runs.push_back({designs[k].name, &design, setup.events.get(),
                    drawn_run(setup, 0, verify::run_of(setup, seed, 0), 0)});
    if (design.compare.empty()) continue;
    const bool several = design.dynamics->components.size() > 2;  // observers
    const auto survey = statistics::survey_figures(*setup.events, design.compare, seed, {1, {0}});
    for (const statistics::FigureSummary& figure : survey.figures)
      if (figure.least)
        numbers.push_back({k,
                           "run 0" +
                               (several && !figure.observer.empty() ? ", " + figure.observer : "") +
                               ": " + figure.title,
                           figure.least->value});
  }
  add_numbers(numbers, designs.size(), table);
  const auto view = [](const model::Design& design) { return view_of(design); };
  return {fmt::format("Run 0 of seed {} of each", seed),
          drawing::svg(figure_of_designs(runs, view)),
          {}};
}

}  // namespace

page::Comparison compared(const std::vector<std::string>& paths,
                          const std::vector<Results>& results) {
  page::Comparison comparison;
  comparison.names = names_of_files(paths);
  std::vector<NamedDesign> designs;
  std::vector<std::string> files;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    files.push_back(gain_file_of(paths[k]));
    designs.push_back({comparison.names[k], load_gains(files.back())});
  }
  Table table(paths.size());
  const auto add_texts = [&](const std::string& what, const auto& text_of) {
    std::vector<std::string> texts;
    for (const Results& one : results) texts.push_back(text_of(one));
    table.add(what, texts);
  };
  add_texts("problem", [](const Results& entry) { return entry.gains.problem_name; });
  add_texts("method", [](const Results& entry) { return entry.gains.statement.method_name; });
  add_texts("verdict", [](const Results& entry) { return to_string(entry.gains.verdict); });
  add_texts("objective", [](const Results& entry) {
    return entry.gains.objective ? brief(*entry.gains.objective) : std::string();
  });
  add_data(designs, table);
  add_matrices(results, "", &model::Gains::gains, table);
  add_matrices(results, "", &model::Gains::report, table);
  add_campaigns(results, table);
  const std::vector<SystemResult> figures = system_results(designs);
  std::vector<SystemNumber> numbers;
  for (const SystemResult& result : figures) {
    numbers.insert(numbers.end(), result.numbers.begin(), result.numbers.end());
    comparison.figures.push_back({result.figure.title,
                                  result.missing.empty() ? drawing::svg(result.figure) : "",
                                  result.facts});
  }
  add_numbers(numbers, designs.size(), table);
  try {
    comparison.figures.push_back(runs_of(designs, files, table));
  } catch (const InputError& error) {
    comparison.figures.push_back({"Runs", "", {"No picture: " + error.message() + "."}});
  }
  comparison.rows = table.take();
  return comparison;
}

std::string comparison_text(const page::Comparison& comparison) {
  std::vector<std::vector<std::string>> lines(1, {""});
  lines.front().insert(lines.front().end(), comparison.names.begin(), comparison.names.end());
  lines.front().push_back(comparison.names.size() == 2 ? "difference" : "");
  for (const page::Comparison::Row& row : comparison.rows) {
    lines.push_back({row.what});
    lines.back().insert(lines.back().end(), row.values.begin(), row.values.end());
  }
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
  std::string text;
  for (const auto& line : lines) {
    std::string cells;
    for (std::size_t k = 0; k < line.size(); ++k)
      cells += fmt::format("{:<{}}", line[k], widths[k] + 2);
    text += cells.substr(0, cells.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace gainsmith::app
