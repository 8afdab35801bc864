// Which problems of a folder belong to which part of `run --shard`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "gainsmith/problem_files.h"
#include "gainsmith/shard_option.h"

namespace gainsmith::app {

/// The indices of each of `shares` shares, in order: the longest work first, each to the share that has
/// least so far. `seconds`: of each piece of work.
std::vector<std::vector<std::size_t>> balanced_shares(const std::vector<double>& seconds,
                                                      std::size_t shares);

/// The problems of a part. `times`: the folder of the results of an earlier run, whose times balance
/// the parts; a problem without one there counts as the mean. Empty: every N-th problem from the I-th
/// on. InputError where the folder has no times.
std::vector<ProblemFile> problems_of_shard(const std::vector<ProblemFile>& all, const Shard& shard,
                                           const std::filesystem::path& times);

}  // namespace gainsmith::app
