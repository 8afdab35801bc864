// What is true, false, or not known (Kleene's logic).
#pragma once

#include <cstdint>

namespace gainsmith {

enum class Truth : std::int8_t { no, unknown, yes };

inline Truth truth_of(bool holds) { return holds ? Truth::yes : Truth::no; }

inline Truth opposite(Truth of) { return of == Truth::unknown ? of : truth_of(of == Truth::no); }

}  // namespace gainsmith
