#include "base/control_groups.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

namespace gainsmith {

namespace {

namespace fs = std::filesystem;

/// The number in a file, divided by a second one; infinite for no file, and for "max".
double limit_in(const fs::path& file) {
  std::ifstream in(file);
  double limit = 0, unit = 1;
  if (!(in >> limit)) return std::numeric_limits<double>::infinity();
  return in >> unit && unit > 0 ? limit / unit : limit;
}

/// Lines of /proc/self/cgroup: "0::/a/b" in version 2, "4:memory:/a/b" in version 1. Empty without.
std::string group_of(const std::string& controller) {
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t at = line.find(':');
    const std::size_t path = line.find(':', at + 1);
    if (path == std::string::npos) continue;
    if (line.substr(at + 1, path - at - 1) == controller) return line.substr(path + 1);
  }
  return "";
}

}  // namespace

double least_of_groups(const std::string& controller, const std::string& file) {
  const std::string group = group_of(controller);
  if (group.empty()) return std::numeric_limits<double>::infinity();
  const fs::path mount = fs::path("/sys/fs/cgroup") / controller;
  double least = limit_in(mount / file);
  for (fs::path at = mount / fs::path(group).relative_path(); at != mount && at.has_parent_path();
       at = at.parent_path())
    least = std::min(least, limit_in(at / file));
  return least;
}

}  // namespace gainsmith
