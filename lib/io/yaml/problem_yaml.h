// Problems from YAML. The keys are described in docs/language.md.
//
// The room reads and writes all files, with three promises. What a person wrote is never guessed:
// an unknown, missing or doubled key is an InputError with file, line, column and the nearest
// spelling. A decimal keeps its digits from the text to exact arithmetic. What is written reads
// back to the same bits and writes again to the same bytes.
//
//   yaml, yaml_value, yaml_error       YAML with places, matrices of lists, causes of errors
//   keys, *_keys, schema               tables of all keys; JSON schemas that are made from them
//   problem_yaml, method_yaml          problems and methods; *_yaml: their sections
//   variant_yaml, setting, sources     problems like others, values from outside, files by name
//   json_text, json_reader, json_place JSON with decimals and places
//   gains_json, campaign_json, ...     results
//   csv_table, log_times, measured_yaml, matrix/   data of files
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

/// Parses a problem, the method that it names or holds, the problems that it is `like`, and the
/// files that it names by paths relative to `file`. `settings` take the place of its values.
/// InputError with the place for every mistake. Shapes are checked where the problem is bound.
model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library,
                             const std::vector<model::Setting>& settings = {});

/// The same with files from elsewhere: those that a gain file states.
model::Problem parse_problem(const std::string& text, const std::string& file,
                             const MethodLibrary& library,
                             const std::vector<model::Setting>& settings, Sources& sources);

}  // namespace gainsmith::io
