// Internal to io: what kind of MAT file some bytes are.
#pragma once

#include <string>

#include "base/error.h"

namespace gainsmith::io {

struct MatLayout {
  bool hdf5 = false;  ///< version 7.3; otherwise 5
  bool big_endian = false;
};

/// InputError at `place` unless the bytes begin like a MAT file of version 5 or 7.3.
MatLayout mat_layout(const std::string& bytes, const std::string& path, const Place& place);

}  // namespace gainsmith::io
