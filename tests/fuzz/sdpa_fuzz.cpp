// libFuzzer target: whatever the bytes, the reader gives a valid problem or an InputError.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/error.h"
#include "sdp/problem.h"
#include "sdp/sdpa_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using gainsmith::sdp::Problem;
  try {
    const Problem problem =
        gainsmith::sdp::read_sdpa({reinterpret_cast<const char*>(data), size}, "fuzz");
    gainsmith::sdp::validate(problem);
  } catch (const gainsmith::InputError&) {
    return 0;
  }
  return 0;
}
