// What `run` writes as result.json beside the results of a problem: how it ended, for those that
// read the folder later.
#pragma once

#include <string>
#include <vector>

#include "io/json/json_text.h"

namespace gainsmith::io {

struct RunResult {
  int exit = 0;
  std::string error;                     ///< why it did not end; empty: it did
  std::string problem_file;              ///< from the folder of the results; empty: standard input
  std::string no_campaign;               ///< why there is none; empty: there is one
  std::vector<std::string> differences;  ///< from `expect:`
  std::string gains_hash;  ///< of the gains that were written (campaign_json.h); empty: none
  double seconds = 0;
};

/// The document of `run --json` on the problem, with what else a RunResult has and the version.
Json result_json(const Json& report, const std::string& problem_file, const std::string& gains_hash,
                 double seconds);

/// InputError with the place for a file that is truncated, of a later version, or lacks a key.
RunResult parse_result(const std::string& text, const std::string& file);

}  // namespace gainsmith::io
