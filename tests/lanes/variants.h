// The variants that this machine has.
#pragma once

#include <vector>

#include "lanes/steps.h"

namespace gainsmith::lanes {

inline std::vector<const Variant*> variants() {
  std::vector<const Variant*> all;
  for (const char* name : {"v2", "v3", "v4"})
    if (const Variant* one = find_variant(name)) all.push_back(one);
  return all;
}

}  // namespace gainsmith::lanes
