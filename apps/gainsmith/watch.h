// Doing something again whenever files change.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace gainsmith::app {

/// Calls `act`, and again after each change of a problem or a table (YAML, CSV, NPY, MAT, JSON)
/// that lies beside one of these, until a stop is
/// requested. What it writes below `own` is no change. The files need not exist meanwhile: editors
/// replace them.
void watch(const std::vector<std::filesystem::path>& files, const std::filesystem::path& own,
           const std::function<void()>& act);

}  // namespace gainsmith::app
