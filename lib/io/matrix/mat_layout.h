// Internal to io: what kind of MAT file some bytes are, and whether they are all there.
#pragma once

#include <string>

#include "base/error.h"

namespace gainsmith::io {

/// InputError at `place` unless the bytes begin like a MAT file of version 5 or 7.3, and, of version 5, when it
/// ends within a variable or holds what is none.
void check_mat_layout(const std::string& bytes, const std::string& path, const Place& place);

}  // namespace gainsmith::io
