#include "gainsmith/results_folder.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/nearest.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/job.h"
#include "gainsmith/load.h"
#include "gainsmith/problem_list.h"
#include "gainsmith/run_table.h"
#include "gainsmith/search_text.h"
#include "gainsmith/summary.h"
#include "gainsmith/system_figures.h"
#include "io/json/campaign_json.h"
#include "io/json/gains_json.h"
#include "io/json/result_json.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kGains = "gains.json";
constexpr const char* kResult = "result.json";

bool is_there(const fs::path& path) {
  std::error_code none;
  return fs::exists(path, none);
}

bool holds_results(const fs::path& folder) {
  return is_there(folder / kGains) || is_there(folder / kResult);
}

std::string run_title(std::uint64_t run, std::uint64_t seed) {
  return "Run " + std::to_string(run) + " of seed " + std::to_string(seed);
}

/// The problem that a gain file states. Its files of data are beside the gain file, or else beside
/// the problem file. Otherwise `results` say why it is not shown.
void add_problem(const fs::path& gains, const fs::path& problem_file, page::Results& results) {
  for (const fs::path& beside : {gains, problem_file}) {
    if (beside.empty()) continue;
    try {
      results.problem = io::stated_problem(results.gains, beside.string());
      results.expects = results.problem->expect.has_value();
      return;
    } catch (const InputError& error) {
      if (results.unreadable.empty()) results.unreadable = error.what();
    }
  }
}

/// The figures of linear systems that the problem asks for.
void add_figures(const fs::path& path, page::Results& results) {
  if (!results.problem || results.problem->figures.empty()) return;
  try {
    for (const SystemResult& result : system_results({{"", load_gains(path)}})) {
      page::SystemFigure& figure = results.figures.emplace_back(
          result.figure.title, result.missing.empty() ? drawing::svg(result.figure) : "",
          result.facts);
      if (!result.missing.empty()) figure.facts.push_back("No picture: " + result.missing + ".");
    }
  } catch (const InputError& error) {
    results.figures.push_back({"Figures", "", {error.message()}});
  }
}

/// What the gain file at `path` says.
page::Results results_of_gains(const fs::path& path, const fs::path& problem_file = {}) {
  page::Results results;
  results.gains = read_gains(path);
  add_problem(path, problem_file, results);
  add_figures(path, results);
  const model::Gains& gains = results.gains;
  results.name = gains.problem_name;
  results.verdict_line = verdict_line(gains);
  results.solver_line = solver_line(gains);
  results.objective_line = objective_line(gains);
  results.search_lines = search_text(gains);
  results.files.emplace_back(path.filename().string(), sha256(read_text(path)));
  for (const auto& [what, seconds] : gains.timings)
    if (what == "total") results.seconds = seconds;
  return results;
}

/// The picture of the first run, or why nothing is simulated.
void draw_first_run(const fs::path& path, page::Results& results) {
  try {
    const LoadedGains loaded = load_run(path);
    const std::uint64_t seed = loaded.stated.design->campaign.seed;
    const auto setup = verify::make_setup(loaded.stated, loaded.gains);
    hybrid::Trajectory run = verify::run_of(*setup, seed, 0);
    results.picture = run_picture(*loaded.stated.design, *setup, 0, run);
    results.picture_title = run_title(0, seed) + ", the first of a campaign";
    results.no_campaign =
        "none was made; gainsmith verify " + path.filename().string() + " makes one.";
  } catch (const InputError& error) {
    results.no_campaign = error.message();
  }
}

/// Whether a tag, from its "<" on, is of no shape or text of a picture, or has an attribute that is
/// a script or a link. Values of attributes are skipped.
bool is_active(std::string_view tag) {
  for (const char* name : {"<script", "<foreignobject", "<!", "<?"})
    if (tag.starts_with(name)) return true;
  for (std::size_t at = 1; at < tag.size() && tag[at] != '>'; ++at) {
    if (tag[at] == '"' || tag[at] == '\'') {
      at = tag.find(tag[at], at + 1);
      if (at == std::string_view::npos) return true;
    } else if (!std::isalnum(static_cast<unsigned char>(tag[at - 1])) &&
               (tag.substr(at).starts_with("on") || tag.substr(at).starts_with("href"))) {
      return true;
    }
  }
  return false;
}

bool has_active_part(std::string svg) {
  std::transform(svg.begin(), svg.end(), svg.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1))
    if (is_active(std::string_view(svg).substr(at))) return true;
  return false;
}

/// InputError for what `run` does not write: a page shows pictures as they are.
void check_picture(const std::string& svg, const fs::path& path) {
  if (!svg.starts_with("<svg ") || !svg.ends_with("</svg>\n"))
    throw InputError({path.string()},
                     "this is no whole picture; run the problem again, or remove it");
  if (has_active_part(svg))
    throw InputError({path.string()},
                     "this is no picture of gainsmith: it holds a script or a link");
}

void add_campaign(const fs::path& path, page::Results& results) {
  const std::string text = read_text(path);
  results.campaign = io::parse_campaign(text, path.string());
  results.campaign_line = campaign_line(*results.campaign);
  results.changed =
      results.changed || results.campaign->gains_hash != io::gains_hash(results.gains);
  results.files.emplace_back(path.filename().string(), sha256(text));
}

void add_picture(const fs::path& path, page::Results& results) {
  results.picture = read_text(path);
  check_picture(results.picture, path);
  if (!results.campaign) return;
  const bool held = results.campaign->verdict == model::CampaignVerdict::held;
  results.picture_title = run_title(results.campaign->worst_run, results.campaign->seed) +
                          (held ? ", the one nearest to a violation" : ", the worst one");
}

std::vector<fs::path> folders_below(const fs::path& root) {
  std::vector<fs::path> found;
  std::error_code error;
  fs::recursive_directory_iterator entry(root, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    if (entry->is_directory(error) && holds_results(entry->path())) found.push_back(entry->path());
  if (error)
    throw InputError({root.string()}, "cannot read all of this folder: " + error.message());
  std::sort(found.begin(), found.end());
  return found;
}

/// InputError for a path that is not there, with the nearest of the results beside it.
void require_results(const fs::path& path) {
  if (is_there(path)) return;
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> beside;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error))
    if (holds_results(entry->path())) beside.push_back(entry->path().filename().string());
  std::sort(beside.begin(), beside.end());
  const std::string folders = "; 'gainsmith run' names the folders by the problem files";
  throw InputError({path.string()}, "no such file or folder" + (beside.empty() ? "" : folders) +
                                        suggestion(path.filename().string(), beside));
}

}  // namespace

page::Results read_folder(const fs::path& folder, const std::string& name) {
  std::optional<io::RunResult> run;
  if (is_there(folder / kResult)) {
    const std::string path = (folder / kResult).string();
    run = io::parse_result(read_text(path), path);
  }
  page::Results results;
  if (!run || !run->gains_hash.empty()) {
    const bool known = run && !run->problem_file.empty();
    results = results_of_gains(folder / kGains, known ? folder / run->problem_file : fs::path());
    if (run) {
      results.no_campaign = run->no_campaign;
      results.differences = run->differences;
      results.changed = run->gains_hash != io::gains_hash(results.gains);
    }
    if (is_there(folder / "campaign.json")) add_campaign(folder / "campaign.json", results);
    if (is_there(folder / "worst-run.svg")) add_picture(folder / "worst-run.svg", results);
  }
  results.name = name;
  if (!run) {
    results.expects = false;  // nothing was compared
    return results;
  }
  results.error = run->error;
  results.mark = mark_of(static_cast<ExitCode>(run->exit));
  results.seconds = run->seconds;
  return results;
}

std::string title_of(const fs::path& path) {
  std::error_code none;
  const fs::path whole = fs::absolute(path, none).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

std::vector<page::Results> read_results(const fs::path& path) {
  if (path == "-")
    throw InputError({"-"}, "expected a gain file or a folder of results, not standard input");
  require_results(path);
  std::error_code none;
  if (!fs::is_directory(path, none)) {
    page::Results results = results_of_gains(path);
    results.expects = false;
    draw_first_run(path, results);
    return {results};
  }
  if (holds_results(path)) return {read_folder(path, title_of(path))};
  std::vector<page::Results> all;
  const std::vector<std::string> listed = read_problem_list(path);
  const auto is_left_over = [&](const std::string& name) {
    return !listed.empty() && std::find(listed.begin(), listed.end(), name) == listed.end();
  };
  for (const fs::path& folder : folders_below(path))
    if (const std::string name = folder.lexically_relative(path).string(); !is_left_over(name))
      all.push_back(read_folder(folder, name));
  for (const std::string& name : listed) {
    if (holds_results(path / name)) continue;
    page::Results missing;
    missing.name = name;
    missing.mark = "missing";
    missing.error = "no result: the part of --shard that has it was not made, or died";
    all.push_back(std::move(missing));
  }
  if (all.empty())
    throw InputError({path.string()}, "no results here; expected those that 'gainsmith run -o " +
                                          path.string() + "' writes");
  return all;
}

}  // namespace gainsmith::app
