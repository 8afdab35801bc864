// What operator new may give, so that a test sees who asks for much.
#pragma once

#include <cstddef>

namespace gainsmith::fuzz {

/// As long as it lives, std::bad_alloc when more than `bytes` are in use beyond what was at its beginning.
class HeapLimit {
 public:
  explicit HeapLimit(std::size_t bytes);
  ~HeapLimit();
  HeapLimit(const HeapLimit&) = delete;
  HeapLimit& operator=(const HeapLimit&) = delete;
};

}  // namespace gainsmith::fuzz
