// Problems from YAML. The keys are described in docs/language.md.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/problem.h"

namespace gainsmith::io {

/// Where methods that a problem names are found.
struct MethodLibrary {
  std::function<std::optional<std::string>(const std::string& name)>
      text;  ///< none: no such method
  std::vector<std::string> names;
};

/// Parses a problem and the method that it names or holds. `file` is used in messages. InputError
/// with the place for every mistake.
model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library);

}  // namespace gainsmith::io
