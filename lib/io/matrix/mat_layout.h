// Internal to io: what kind of MAT file some bytes are.
#pragma once

#include <string>

#include "base/error.h"

namespace gainsmith::io {

/// Whether numbers begin with their highest byte. InputError at `place` unless the bytes begin like a
/// MAT file of version 5; the message says how to save a file of another version again.
bool is_big_endian(const std::string& bytes, const std::string& path, const Place& place);

}  // namespace gainsmith::io
