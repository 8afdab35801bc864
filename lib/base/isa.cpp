#include "base/isa.h"

#include <cstdlib>

#include "base/error.h"

namespace gainsmith {

bool has_isa(const std::string& name) {
  if (name == "v2") return true;
#if defined(__x86_64__)
  __builtin_cpu_init();
  // By what they add, since not every compiler knows the names of the levels.
  const bool is_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                     __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  if (name == "v3") return is_v3;
  if (name == "v4")
    return is_v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#endif
  return false;
}

namespace {

std::string chosen() {
  if (const char* name = std::getenv("GAINSMITH_ISA"); name != nullptr && *name != '\0') {
    if (!has_isa(name))
      throw InputError(Place{}, "GAINSMITH_ISA=" + std::string(name) +
                                    ": expected v2, v3 or v4, and no more than this machine has");
    return name;
  }
  for (const char* name : {"v4", "v3"})
    if (has_isa(name)) return name;
  return "v2";
}

}  // namespace

/// Without a fault for a wrong name in the environment: isa() reports that.
const bool has_fused_multiply_add = [] {
  const char* name = std::getenv("GAINSMITH_ISA");
  return has_isa("v3") && (name == nullptr || std::string(name) != "v2");
}();

const std::string& isa() {
  static const std::string best = chosen();
  return best;
}

}  // namespace gainsmith
