// The names of all problems whose parts `run --shard` puts into one folder, so that a page of the
// results knows which are missing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gainsmith::app {

/// Writes the names into the folder, which it makes, in place of those of an earlier command.
void write_problem_list(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// None where there is no list.
std::vector<std::string> read_problem_list(const std::filesystem::path& folder);

}  // namespace gainsmith::app
