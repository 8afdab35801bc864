#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "gainsmith/certify.h"
#include "gainsmith/commands.h"
#include "gainsmith/job.h"
#include "gainsmith/junit.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/problem_files.h"
#include "gainsmith/problem_list.h"
#include "gainsmith/problem_shares.h"
#include "gainsmith/progress_line.h"
#include "gainsmith/results_folder.h"
#include "gainsmith/shard_option.h"
#include "gainsmith/terminal.h"
#include "gainsmith/watch.h"
#include "page/page.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::vector<std::string> problems;
  std::string output = "gainsmith-run";
  std::string junit;
  std::string shard;
  std::string times;
  unsigned threads = 0;
  bool json = false;
  bool report = false;
  bool certify = false;
  bool watch = false;
  JobOptions job;
};

std::string json_text(const std::vector<JobResult>& results, ExitCode worst) {
  io::Json problems = io::Json::array();
  io::Json seconds = io::Json::object();
  for (const JobResult& result : results) {
    problems.push_back(result.report);
    seconds[result.name] = result.seconds;
  }
  return io::to_text(
      {{"exit", static_cast<int>(worst)}, {"problems", problems}, {"timings", seconds}});
}

/// Prints the results in their order, each as soon as all before it are there: what is finished is
/// on paper when the program is stopped.
class Lines {
 public:
  explicit Lines(const std::vector<ProblemFile>& items) : results_(items.size()) {
    for (const ProblemFile& item : items) width_ = std::max(width_, item.name.size());
  }

  void add(std::size_t index, const JobResult& result) {
    const std::scoped_lock lock(mutex_);
    results_[index] = &result;
    clear_progress();
    for (; next_ < results_.size() && results_[next_] != nullptr; ++next_) print(*results_[next_]);
    std::fflush(stdout);
  }

  /// "3 problems: 2 ok, 1 NO".
  std::string total() const {
    std::map<ExitCode, int> counts;
    for (const JobResult* result : results_)
      if (result != nullptr) ++counts[result->exit];
    std::string text = fmt::format("{} problems:", results_.size());
    std::string mark = " ";
    for (const auto& [exit, count] : counts)
      text += std::exchange(mark, ", ") + fmt::format("{} {}", count, mark_of(exit));
    return text + "\n";
  }

 private:
  void print(const JobResult& result) const {
    fmt::print("{:<11} {:<{}}  {}\n", mark_of(result.exit), result.name, width_, result.line);
    for (const std::string& cause : result.causes) fmt::print("            {}\n", cause);
    for (const std::string& difference : result.differences)
      fmt::print("            {}\n", difference);
  }

  std::mutex mutex_;
  std::vector<const JobResult*> results_;  ///< null: not finished
  std::size_t next_ = 0;                   ///< the first that is not printed
  std::size_t width_ = 10;
};

std::string report_file(const RunOptions& options) {
  return (fs::path(options.output) / "report.html").string();
}

/// The page of the results, beside their folders.
void write_report(const RunOptions& options, const std::vector<JobResult>& results) {
  std::vector<page::Results> all;
  for (const JobResult& result : results) {
    page::Results shown;
    if (!result.interrupted && !result.gains_hash.empty())
      shown = read_folder(fs::path(options.output) / result.name, result.name);
    else
      shown.error = result.line;
    shown.name = result.name;
    shown.mark = mark_of(result.exit);
    all.push_back(std::move(shown));
  }
  const std::string title = all.size() == 1 ? all.front().name : title_of(options.output);
  write_atomically(report_file(options), page::page(all, title));
}

/// The names are those among all.
std::vector<ProblemFile> own_problems(const RunOptions& options) {
  if (!options.times.empty() && options.shard.empty())
    throw InputError({"--times"},
                     "expected --shard I/N too: the times share out the problems to its parts");
  std::error_code none;
  if (!options.times.empty() && fs::equivalent(options.times, options.output, none))
    throw InputError({options.times},
                     "the times must not change while parts are made; write the results to another "
                     "folder with -o");
  const std::vector<ProblemFile> all = problem_files(options.problems);
  if (!options.shard.empty()) {
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const ProblemFile& problem : all) names.push_back(problem.name);
    write_problem_list(options.output, names);
  }
  return problems_of_shard(all, parse_shard(options.shard), options.times);
}

/// InputError for standard output, which has the lines of results, or their JSON.
void refuse_standard_output(const RunOptions& options) {
  if (options.output == "-") throw InputError({"-o"}, "expected a folder for the results, not '-'");
  if (options.junit == "-")
    throw InputError({"--junit"}, "expected a file: standard output has the lines of the results");
}

/// Undecided unless the second program agrees with all gain files.
ExitCode certified(const RunOptions& options, const std::vector<JobResult>& results) {
  std::vector<std::string> files;
  for (const JobResult& result : results)
    if (!result.interrupted && !result.gains_hash.empty())
      files.push_back((fs::path(options.output) / result.name / "gains.json").string());
  const bool agrees = files.empty() || certify(std::move(files)) == ExitCode::yes;
  return agrees ? ExitCode::yes : ExitCode::undecided;
}

/// As the result of one more problem, for JUnit.
JobResult disagreement() {
  JobResult result;
  result.exit = ExitCode::undecided;
  result.name = "certify";
  result.line = "the second program does not agree with each gain file: its lines say why";
  result.causes = {result.line};
  return result;
}

ExitCode run(const RunOptions& options) {
  refuse_standard_output(options);
  if (options.certify) require_certify();
  const std::vector<ProblemFile> items = own_problems(options);
  if (items.empty()) say(fmt::format("part {} has no problem\n", options.shard));
  const std::string page = options.report ? report_file(options) : "";
  for (const ProblemFile& item : items) prepare_outputs(item.path.string(), {options.junit, page});
  JobOptions job = options.job;
  job.threads = options.threads;
  std::vector<JobResult> results(items.size());
  Lines lines(items);
  // Of one problem its own progress is shown.
  const Doing doing("problems", items.size() > 1 ? items.size() : 0);
  const auto run_one = [&](std::size_t i) {
    results[i] =
        run_job(items[i].path, items[i].name, fs::path(options.output) / items[i].name, job);
    doing.step();
    if (!options.json) lines.add(i, results[i]);
  };
  try {
    parallel_for(items.size(), options.threads, run_one);
  } catch (const Stopped&) {
    // The others say that they have not begun.
    for (std::size_t i = 0; i < items.size(); ++i)
      if (results[i].name.empty()) run_one(i);
  }
  const Telling telling;
  ExitCode worst = ExitCode::yes;
  for (const JobResult& result : results) worst = std::max(worst, result.exit);
  if (options.json) fmt::print("{}", json_text(results, worst));
  if (!options.json && results.size() > 1) fmt::print("{}", lines.total());
  if (options.report) write_report(options, results);
  if (options.certify && certified(options, results) != ExitCode::yes) {
    worst = std::max(worst, ExitCode::undecided);
    results.push_back(disagreement());
  }
  if (!options.junit.empty()) write_atomically(options.junit, junit_text(results));
  const auto open = std::count_if(results.begin(), results.end(),
                                  [](const JobResult& result) { return result.interrupted; });
  if (open > 0)
    say(fmt::format("interrupted: {} of {} problems have no answer{}\n", open, results.size(),
                    options.job.resume
                        ? "; the same command keeps the others and begins these again"
                        : "; with --resume the same command keeps the others"));
  return worst;
}

/// The problems again after each change of a file beside them; the exit code of the last time.
ExitCode run_again(const RunOptions& options) {
  std::vector<fs::path> files;
  for (const ProblemFile& item : own_problems(options)) files.push_back(item.path);
  if (options.problems == std::vector<std::string>{"-"})
    throw InputError({"--watch"}, "standard input does not change: give a file");
  ExitCode last = ExitCode::yes;
  watch(files, options.output, [&] {
    try {
      last = run(options);
    } catch (const InputError& error) {
      say(std::string(error.what()) + "\n");
      last = ExitCode::bad_input;
    }
  });
  return last;
}

}  // namespace

Command run_command() {
  auto options = std::make_shared<RunOptions>();
  return {
      "run",
      "Synthesize, verify and compare with what is expected: for batch scripts and CI",
      {Option("problems", options->problems,
              "problem files, or folders of them; - for standard input")
           .required(),
       set_option(options->job.set),
       Option("-o,--output", options->output,
              "folder for the results: one folder a problem in it, named after its file, such as "
              "motor for a/motor.yaml"),
       Option("--runs", options->job.runs, "runs of each campaign (default: the problem's)")
           .within<std::uint64_t>(1, 1000000000000000),
       Option("--seed", options->job.seed, "seed (default: the problem's)"),
       Option("--threads", options->threads,
              "threads, 0: as many as cores it may use; results do not depend on it")
           .within(0, 1024),
       shard_option(options->shard,
                    "only part I of N of the problems; the parts may share the folder of results"),
       Option("--times", options->times,
              "results of an earlier run, whose times make the parts take equally long"),
       Option("--resume", options->job.resume,
              "keep the results that are whole and of the same problem, runs and seed: after a "
              "stop of any kind the same command goes on"),
       Option("--strict", options->job.strict,
              "a note on a problem or its runs is an error (exit code 2)"),
       Option("--junit", options->junit, "write JUnit XML here"),
       Option("--report", options->report, "write report.html into the folder of the results")
           .excludes({"--shard"}),
       Option("--watch", options->watch,
              "run again whenever a file beside the problems changes, until Ctrl-C")
           .excludes({"--shard", "--resume"}),
       Option("--json", options->json, "print the results as JSON"),
       Option("--certify", options->certify,
              "prove the gain files by the second program too; exit code 3 unless it agrees")
           .excludes({"--json"})},
      "Prints one line a problem; the exit code is the worst of all.\n"
      "Two files of one name have a/motor and b/motor. A file of a folder of problems has its path "
      "from there.\n"
      "Examples:\n"
      "  gainsmith run problem.yaml -o out\n"
      "  gainsmith run problems/ -o out --junit out/junit.xml",
      [options] { return options->watch ? run_again(*options) : run(*options); }};
}

}  // namespace gainsmith::app
