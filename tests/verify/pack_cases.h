// Problems whose campaigns packs run, by name.
#pragma once

#include <ostream>
#include <string>

namespace gainsmith::verify {

struct PackCase {
  const char* name;
  std::string text;
};

inline void PrintTo(const PackCase& one, std::ostream* out) { *out << one.name; }

}  // namespace gainsmith::verify
