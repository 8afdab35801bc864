#include "lanes/steps.h"

#include <cstdlib>

#include "base/error.h"

namespace gainsmith::lanes {

extern const Variant variant_v2, variant_v3, variant_v4;

const Variant* find_variant(const std::string& name) {
  __builtin_cpu_init();
  if (name == "v2") return &variant_v2;
  // By what they add, since not every compiler knows the names of the levels.
  const bool is_v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                     __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  if (name == "v3" && is_v3) return &variant_v3;
  const bool is_v4 = is_v3 && __builtin_cpu_supports("avx512f") &&
                     __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
                     __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (name == "v4" && is_v4) return &variant_v4;
  return nullptr;
}

namespace {

const Variant& chosen() {
  if (const char* name = std::getenv("GAINSMITH_ISA"); name != nullptr && *name != '\0') {
    const Variant* found = find_variant(name);
    if (found == nullptr)
      throw InputError(Place{}, "GAINSMITH_ISA=" + std::string(name) +
                                    ": expected v2, v3 or v4, and no more than this machine has");
    return *found;
  }
  for (const char* name : {"v4", "v3"})
    if (const Variant* found = find_variant(name)) return *found;
  return variant_v2;
}

}  // namespace

const Variant& variant() {
  static const Variant& best = chosen();
  return best;
}

}  // namespace gainsmith::lanes
