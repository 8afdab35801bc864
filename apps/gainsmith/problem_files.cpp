#include "gainsmith/problem_files.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <system_error>

#include "base/error.h"
#include "base/visible.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "-";

bool is_folder(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

bool is_problem(const fs::path& path) {
  const fs::path ending = path.extension();
  return (ending == ".yaml" || ending == ".yml") && !is_hidden(path) && !is_folder(path);
}

/// The path without its ending; a name that would mean a folder, as "..." of "...yaml", keeps it.
fs::path without_ending(fs::path path) {
  const fs::path stem = path.stem();
  return stem == "." || stem == ".." ? path : path.replace_extension();
}

/// One path for all paths to a file; of one that does not exist its own.
fs::path identity(const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  return error ? fs::absolute(path, error).lexically_normal() : real;
}

/// The end of a path: its name and as many of its folders.
std::string end_of(const fs::path& path, std::size_t folders) {
  fs::path end = path.filename();
  for (fs::path above = path.parent_path(); folders > 0 && above.has_filename(); --folders) {
    end = above.filename() / end;
    above = above.parent_path();
  }
  return end.string();
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
    if (is_folder(entry->path()) && is_hidden(entry->path())) entry.disable_recursion_pending();
    if (!is_problem(entry->path())) continue;
    files.push_back(
        {entry->path(), without_ending(entry->path().lexically_relative(folder)).string()});
  }
  require(error);
  std::sort(files.begin(), files.end(),
            [](const ProblemFile& a, const ProblemFile& b) { return a.path < b.path; });
  // One that cannot be read, so that the others are run all the same.
  if (files.empty()) files.push_back({folder / "*.yaml", end_of(identity(folder), 0)});
  return files;
}

/// Whether any two are equal.
bool repeat(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return std::adjacent_find(names.begin(), names.end()) != names.end();
}

/// Names of files that would have one name: their paths from the last folder on in which they
/// differ, with their endings where these alone do.
void tell_apart(const std::vector<ProblemFile*>& files) {
  const auto named = [&](std::size_t folders, bool ending) {
    std::vector<std::string> names;
    for (const ProblemFile* file : files) {
      const fs::path path = identity(file->path);
      names.push_back(end_of(ending ? path : without_ending(path), folders));
    }
    return names;
  };
  std::size_t most = 0;
  for (const ProblemFile* file : files) {
    const fs::path path = identity(file->path);
    most = std::max(most, static_cast<std::size_t>(std::distance(path.begin(), path.end())));
  }
  std::vector<std::string> names = named(0, true);
  for (std::size_t folders = 1; folders < most && repeat(names); ++folders)
    names = named(folders, false);
  if (repeat(names)) names = named(most, true);
  for (std::size_t k = 0; k < files.size(); ++k) files[k]->name = names[k];
}

}  // namespace

std::vector<ProblemFile> problem_files(const std::vector<std::string>& paths) {
  std::vector<ProblemFile> files;
  std::set<std::string> known;
  const auto add = [&](ProblemFile file) {
    if (control_character(file.name) != std::string::npos)
      throw InputError({file.path.string()}, "the name of the file has control characters");
    if (known.insert(identity(file.path).string()).second) files.push_back(std::move(file));
  };
  for (const fs::path path : paths) {
    if (path == kStandardInput) {
      add({path, "standard-input"});
    } else if (is_folder(path)) {
      for (ProblemFile& file : files_below(path)) add(std::move(file));
    } else {
      add({path, without_ending(path).filename().string()});
    }
  }
  // A new name may be that of another file.
  bool changed = true;
  for (std::size_t round = 0; changed && round < files.size(); ++round) {
    std::map<std::string, std::vector<ProblemFile*>> by_name;
    for (ProblemFile& file : files) by_name[file.name].push_back(&file);
    changed = false;
    for (const auto& [name, alike] : by_name)
      if (alike.size() > 1) {
        tell_apart(alike);
        changed = true;
      }
  }
  return files;
}

}  // namespace gainsmith::app
