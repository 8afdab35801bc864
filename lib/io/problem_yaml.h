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

/// What is said of a name that no method has.
std::string unknown_method(const std::string& name, const std::vector<std::string>& names);

class Sources;

/// Parses a problem, the method that it names or holds, the problems that it is `like`, and the files
/// that it names by paths relative to `file`. `settings` take the place of its values. InputError with
/// the place for every mistake.
model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library,
                             const std::vector<model::Setting>& settings = {});

/// The same with files from elsewhere: those that a gain file states.
model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library,
                             const std::vector<model::Setting>& settings, Sources& sources);

}  // namespace gainsmith::io
