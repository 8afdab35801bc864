// libFuzzer target of one reader; scripts/fuzz builds and runs them.
#include <cstddef>
#include <cstdint>

#include "fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gainsmith::fuzz::GAINSMITH_READER({reinterpret_cast<const char*>(data), size});
  return 0;
}
