// Results as a page shows them, from the files that `run`, `synth` and `verify` write.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "page/results.h"

namespace gainsmith::app {

/// Of a gain file, the folder of one problem, or a folder of many, in the order of their paths; of
/// parts of `run --shard` those of the last command, then those that no part has made. A
/// gain file alone has the picture of its first run. InputError with the place for a folder without
/// results, a file that is truncated or of a later version, and what is no result.
std::vector<page::Results> read_results(const std::filesystem::path& path);

/// Of the folder of one problem.
page::Results read_folder(const std::filesystem::path& folder, const std::string& name);

/// "out/motor" of "out/motor/": what a page of it is called.
std::string title_of(const std::filesystem::path& path);

}  // namespace gainsmith::app
