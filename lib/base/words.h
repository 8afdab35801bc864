// The words of the values of enums.
#pragma once

#include <cstddef>
#include <string>

namespace gainsmith {

/// `words`: of all values of the enum from 0 to `last`, in their order.
template <auto last, std::size_t count>
std::string word_of(decltype(last) value, const char* const (&words)[count]) {
  static_assert(count == static_cast<std::size_t>(last) + 1, "a word for each value");
  return words[static_cast<std::size_t>(value)];
}

}  // namespace gainsmith
