// Results of `run` that are there already: with --resume they are kept.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "gainsmith/job.h"
#include "model/instance.h"

namespace gainsmith::app {

/// The fingerprint of all that the files of a result follow from: problem, version, runs, seed.
std::string job_fingerprint(const model::Instance& instance, const JobOptions& options);

/// The document result.json of a result that has an answer, with what job_from() needs.
io::Json with_fingerprint(io::Json document, const JobResult& result);

/// The result that an earlier run left in the folder, when it has this fingerprint and its files are
/// whole; none otherwise.
std::optional<JobResult> kept_job(const std::filesystem::path& folder, const std::string& name,
                                  const std::string& fingerprint);

}  // namespace gainsmith::app
