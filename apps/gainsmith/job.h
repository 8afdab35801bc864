// One problem from the file to the verdict, as `run` does it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

struct JobOptions {
  std::optional<std::uint64_t> runs;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set{};  ///< "NAME=VALUE", in each problem
  unsigned threads = 1;            ///< of the search and of the campaign
  bool resume = false;             ///< results that are there stay (kept_job.h)
  bool strict = false;             ///< notes (notes.h) are errors
};

struct JobResult {
  ExitCode exit = ExitCode::fault;
  std::string name;                 ///< of the problem's folder in the output
  std::string line;                 ///< "yes, objective 688.572; held in 1000 runs, worst run 627"
  std::vector<std::string> causes;  ///< why it is not ok, the first at first
  std::vector<std::string> differences;  ///< from `expect:`
  io::Json report;                       ///< without timings
  std::string gains_hash;  ///< of the gains that were written (io/json/campaign_json.h)
  double seconds = 0;
  std::string fingerprint;   ///< job_fingerprint(); empty where the problem could not be read
  bool kept = false;         ///< of an earlier run
  bool interrupted = false;  ///< by Ctrl-C, before it was decided; then nothing was written
};

/// Synthesizes, verifies when there are gains, compares with `expect:` and writes gains.json,
/// campaign.json, worst-run.svg, summary.txt and, of a violated campaign, worst-run.csv into
/// `folder`; at last result.json, of wrong input too, which may be all that the folder then holds.
/// What `expect:` does not name must be as usual: the verdict yes, the campaign held. Throws
/// nothing but OptimizersNeeded, before anything is written: a wrong input is a result too.
JobResult run_job(const std::filesystem::path& problem, const std::string& name,
                  const std::filesystem::path& folder, const JobOptions& options);

/// "ok", "NO", "ERROR", "UNDECIDED", "FAULT".
std::string mark_of(ExitCode exit);

}  // namespace gainsmith::app
