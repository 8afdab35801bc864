#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace gainsmith {

namespace {

namespace fs = std::filesystem;

/// The limit that a file of a control group holds; infinite without one ("max", no file).
double limit_in(const fs::path& file) {
  std::ifstream in(file);
  double bytes = 0;
  return in >> bytes ? bytes : std::numeric_limits<double>::infinity();
}

/// The least limit of a group and of those around it.
double limit_of_group(const fs::path& mount, const std::string& group, const char* file) {
  double least = limit_in(mount / file);
  for (fs::path at = mount / fs::path(group).relative_path(); at != mount && at.has_parent_path();
       at = at.parent_path())
    least = std::min(least, limit_in(at / file));
  return least;
}

/// Lines of /proc/self/cgroup: "0::/a/b" in version 2, "4:memory:/a/b" in version 1.
double limit_of_groups() {
  double least = std::numeric_limits<double>::infinity();
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t at = line.find(':');
    const std::size_t path = line.find(':', at + 1);
    if (path == std::string::npos) continue;
    const std::string kind = line.substr(at + 1, path - at - 1);
    const std::string group = line.substr(path + 1);
    if (kind.empty())
      least = std::min(least, limit_of_group("/sys/fs/cgroup", group, "memory.max"));
    if (kind == "memory")
      least =
          std::min(least, limit_of_group("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

}  // namespace

double memory_limit() {
  double least =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    least = std::min(least, static_cast<double>(space.rlim_cur));
  return std::min(least, limit_of_groups());
}

}  // namespace gainsmith
