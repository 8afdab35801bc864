#include "gainsmith/problem_files.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "base/error.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "-";

bool is_folder(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

bool is_problem(const fs::directory_entry& entry) {
  const fs::path ending = entry.path().extension();
  return (ending == ".yaml" || ending == ".yml") && !is_folder(entry.path());
}

std::vector<ProblemFile> files_below(const fs::path& folder) {
  const auto require = [&](const std::error_code& error) {
    if (error)
      throw InputError({folder.string()}, "cannot read all of this folder: " + error.message());
  };
  std::vector<ProblemFile> files;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  require(error);
  for (; entry != fs::recursive_directory_iterator(); entry.increment(error), require(error)) {
    if (!is_problem(*entry)) continue;
    fs::path relative = entry->path().lexically_relative(folder);
    files.push_back({entry->path(), relative.replace_extension().string()});
  }
  require(error);
  std::sort(files.begin(), files.end(),
            [](const ProblemFile& a, const ProblemFile& b) { return a.path < b.path; });
  if (files.empty()) throw InputError({folder.string()}, "this folder holds no .yaml file");
  return files;
}

/// One text for all ways to a file; of one that does not exist its path.
std::string identity(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? path.lexically_normal().string() : real.string();
}

}  // namespace

std::vector<ProblemFile> problem_files(const std::vector<std::string>& paths) {
  std::vector<ProblemFile> files;
  std::set<std::string> known;
  const auto add = [&](ProblemFile file) {
    if (known.insert(identity(file.path)).second) files.push_back(std::move(file));
  };
  for (const fs::path path : paths) {
    if (path == kStandardInput) {
      add({path, "standard-input"});
    } else if (is_folder(path)) {
      for (ProblemFile& file : files_below(path)) add(std::move(file));
    } else {
      add({path, path.stem().string()});
    }
  }
  return files;
}

}  // namespace gainsmith::app
