// Whole numbers as a command line gives them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gainsmith::app {

/// The number of a decimal text whose value is whole and fits, "10000", "1e4" or "2.5e3"; none for
/// any other text, and for one with a sign.
std::optional<std::uint64_t> parse_whole(const std::string& text);

}  // namespace gainsmith::app
