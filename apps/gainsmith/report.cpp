#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "gainsmith/commands.h"
#include "gainsmith/compared_designs.h"
#include "gainsmith/output.h"
#include "gainsmith/results_folder.h"
#include "gainsmith/terminal.h"
#include "page/page.h"

namespace gainsmith::app {

namespace {

struct ReportOptions {
  std::vector<std::string> results;
  std::string output;
  bool json = false;
};

io::Json line_json(const page::Results& results) {
  if (!results.error.empty()) return {{"name", results.name}, {"error", results.error}};
  const model::Gains& gains = results.gains;
  return {
      {"name", results.name},
      {"method", gains.statement.method_name},
      {"verdict", to_string(gains.verdict)},
      {"objective", gains.objective ? io::Json(*gains.objective) : io::Json()},
      {"campaign", results.campaign ? io::Json(to_string(results.campaign->verdict)) : io::Json()},
      {"differences", results.differences},
      {"changed", results.changed},
      {"seconds", results.seconds ? io::Json(*results.seconds) : io::Json()}};
}

void write_page(const ReportOptions& options, const std::string& page) {
  if (options.output.empty() || options.output == "-") {
    fmt::print("{}", page);
  } else {
    write_atomically(options.output, page);
    say("wrote " + options.output + "\n");
  }
}

/// Designs side by side: the table on the terminal too, where the page goes to a file.
ExitCode report_several(const ReportOptions& options) {
  std::vector<page::Results> all;
  for (const std::string& path : options.results) {
    const std::vector<page::Results> own = read_results(path);
    if (own.size() != 1)
      throw InputError({path}, "several problems; designs that are compared are of one each");
    all.push_back(own.front());
  }
  const page::Comparison comparison = compared(options.results, all);
  for (std::size_t k = 0; k < all.size(); ++k) all[k].name = comparison.names[k];
  const Telling telling;
  const bool to_file = !options.output.empty() && options.output != "-";
  if (options.json) {
    io::Json rows = io::Json::array();
    for (const page::Comparison::Row& row : comparison.rows)
      rows.push_back({{"what", row.what}, {"values", row.values}});
    fmt::print("{}", io::to_text({{"designs", comparison.names}, {"rows", rows}}));
  } else if (to_file) {
    fmt::print("{}", comparison_text(comparison));
    std::fflush(stdout);
  }
  std::string title;
  for (const std::string& name : comparison.names) title += (title.empty() ? "" : ", ") + name;
  if (!options.json || to_file) write_page(options, page::page(all, title, comparison));
  return ExitCode::yes;
}

ExitCode report(const ReportOptions& options) {
  for (const std::string& path : options.results) prepare_outputs(path, {options.output});
  if (options.results.size() > 1) return report_several(options);
  const std::vector<page::Results> results = read_results(options.results.front());
  const auto missing = std::count_if(results.begin(), results.end(),
                                     [](const auto& one) { return one.mark == "missing"; });
  const ExitCode exit = missing > 0 ? ExitCode::undecided : ExitCode::yes;
  if (missing > 0)
    say(fmt::format("{} of {} problems have no result: parts of 'run --shard' are missing\n",
                    missing, results.size()));
  const Telling telling;
  const bool to_stdout = options.output.empty() || options.output == "-";
  if (options.json) {
    io::Json table = io::Json::array();
    for (const page::Results& one : results) table.push_back(line_json(one));
    fmt::print("{}", io::to_text(table));
    if (to_stdout) return exit;
  }
  const std::string title =
      results.size() == 1 ? results.front().name : title_of(options.results.front());
  write_page(options, page::page(results, title));
  return exit;
}

}  // namespace

Command report_command() {
  auto options = std::make_shared<ReportOptions>();
  return {
      "report",
      "Write results as one page (HTML): mathematics, verdicts, gains, campaigns, pictures",
      {Option(
           "results", options->results,
           "gain file (JSON), or a folder that 'gainsmith run -o' wrote, of one problem or many; "
           "several of one problem each are compared")
           .required(),
       Option("-o,--output", options->output, "write the page here (default: standard output)"),
       Option("--json", options->json,
              "print the table as JSON; a page is then written with -o alone")},
      "The page needs no network, no script and no other file.\n"
      "Exit code: 0, 2 wrong input, 3 parts of 'run --shard' are missing.\n"
      "Examples:\n"
      "  gainsmith report gains.json -o report.html\n"
      "  gainsmith report slow.json fast.json -o both.html\n"
      "  gainsmith run problems/ -o out && gainsmith report out -o report.html",
      [options] { return report(*options); }};
}

}  // namespace gainsmith::app
