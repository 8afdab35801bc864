// "--shard 3/8": one of several parts of some work.
#pragma once

#include <cstdint>
#include <string>

#include "gainsmith/command_line.h"

namespace gainsmith::app {

struct Shard {
  std::uint64_t index = 1;  ///< from 1 on
  std::uint64_t of = 1;
};

/// The option; `text` takes what is given, `what` says what a part is of.
Option shard_option(std::string& text, const std::string& what);

/// What the option took.
Shard parse_shard(const std::string& text);

/// "3/8".
std::string to_text(const Shard& shard);

}  // namespace gainsmith::app
