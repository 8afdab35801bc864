// The choice of a variant, once a process. Level v2 is the least that the program runs on.
#include "lanes/steps.h"

#include "base/isa.h"

namespace gainsmith::lanes {

extern const Variant variant_v2, variant_v3, variant_v4;

const Variant* find_variant(const std::string& name) {
  if (!has_isa(name)) return nullptr;
  return name == "v4" ? &variant_v4 : name == "v3" ? &variant_v3 : &variant_v2;
}

const Variant& variant() {
  static const Variant& best = *find_variant(isa());
  return best;
}

}  // namespace gainsmith::lanes
