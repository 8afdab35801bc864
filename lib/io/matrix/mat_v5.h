// Internal to io: MAT files of version 5 (MathWorks, MAT-File Format, chapter 1), read here: matio takes the types and
// lengths of a damaged file as they are.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "base/error.h"
#include "model/stated_file.h"

namespace gainsmith::io {

/// The first `most` bytes of what zlib compressed; empty when it is damaged.
using Inflate = std::function<std::string(std::string_view bytes, std::size_t most)>;

/// The matrix under `name`, as mat_matrix gives it. InputError at `place` also for a file that ends within a variable.
model::StatedMatrix matrix_of_v5(std::string_view bytes, bool big_endian, const std::string& path,
                                 const std::string& name, const Place& place,
                                 const Inflate& inflate);

}  // namespace gainsmith::io
