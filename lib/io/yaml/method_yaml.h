// Methods from YAML. The keys are described in docs/language.md.
#pragma once

#include <string>

#include "model/method.h"

namespace gainsmith::io {

/// Parses a method. `file` is used in messages. InputError with the place for every mistake.
model::Method parse_method(const std::string& text, const std::string& file);

}  // namespace gainsmith::io
