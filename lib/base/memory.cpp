#include "base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "base/control_groups.h"

namespace gainsmith {

double memory_limit() {
  double least =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    least = std::min(least, static_cast<double>(space.rlim_cur));
  return std::min({least, least_of_groups("", "memory.max"),
                   least_of_groups("memory", "memory.limit_in_bytes")});
}

}  // namespace gainsmith
