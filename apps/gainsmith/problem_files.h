// The problem files that a command line names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gainsmith::app {

/// A problem file and a name for it.
struct ProblemFile {
  std::filesystem::path path;
  std::string name;  ///< that of no other: without its ending; below a folder that was named, the
                     ///< path from there; after as many of its folders as others with it need
};

/// The files, and those ending in .yaml or .yml below the folders, sorted: each once, by the first
/// of the paths that lead to it. "-" is standard input. Links to folders are not followed; a link
/// to nothing is left out, unless it ends like a problem file. InputError for a folder that cannot
/// be read or holds no problem.
std::vector<ProblemFile> problem_files(const std::vector<std::string>& paths);

}  // namespace gainsmith::app
