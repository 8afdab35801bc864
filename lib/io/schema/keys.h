// The keys of the files that people write and of gain files, level by level: the readers find the
// keys here, and the schemas (schema.h) are made from the same tables.
#pragma once

#include <span>
#include <string_view>

namespace gainsmith::io {

/// A key of a mapping. `form` says what its value may be:
///
///     text  number  whole  truth  nothing     a scalar; a text of YAML is any scalar
///     never                                   this key means something else
///     'word'                                  this text
///     [F]  [F]+  [F, F]                       a list, one that is not empty, a pair
///     {F}  {F}?  {F}+  {F}1                   a mapping with the user's names: any, or left empty;
///                                             not empty; of one name
///     NAME                                    a level or a named form
///     F | F                                   either
struct Key {
  std::string_view name;  ///< one with a bracket, "f(x)", represents every such name
  std::string_view form;
  std::string_view text = "";  ///< for a person
  bool required = false;
};

/// For the last member of Key.
inline constexpr bool kRequired = true;

/// What keys ask of each other; several are separated by commas.
struct Rule {
  enum class Kind { exactly_one, at_most_one, some, needs, excludes };
  Kind kind;
  std::string_view key;
  std::string_view others;

  static constexpr Rule exactly_one(std::string_view keys) { return {Kind::exactly_one, "", keys}; }
  static constexpr Rule at_most_one(std::string_view keys) { return {Kind::at_most_one, "", keys}; }
  /// One at least.
  static constexpr Rule some(std::string_view keys) { return {Kind::some, "", keys}; }
  /// Where `key` is present, one of the others is.
  static constexpr Rule needs(std::string_view key, std::string_view others) {
    return {Kind::needs, key, others};
  }
  /// Where `key` is present, none of the others is.
  static constexpr Rule excludes(std::string_view key, std::string_view others) {
    return {Kind::excludes, key, others};
  }
};

/// A mapping with known keys.
struct Level {
  std::string_view name;
  std::string_view text;
  std::span<const Key> keys;
  std::span<const Rule> rules = {};
  std::string_view rest = "";  ///< the form of all other keys; empty: there are none

  /// The entry of a key; null where the level has none.
  const Key* find(std::string_view key) const;
};

/// std::logic_error when a reader asks for a key that its table lacks.
void require_known(const Level& level, std::string_view key);

/// A form with a name.
struct NamedForm {
  std::string_view name;
  std::string_view form;
};

/// Of noise, starts and uncertain data.
inline constexpr Key kNormalKey = {"normal", "matrix | normal", "its deviation, or more of it"};
inline constexpr Key kLognormalKey = {"lognormal", "matrix | lognormal",
                                      "the deviation of its logarithm, or more of it"};

/// The levels of problem and method files.
namespace keys {
extern const Level problem, data, data_file, synthesis, way, campaign, law, accuracy, start,
    ellipsoid, normal, lognormal, expectation, expected_value, expected_figure, limits, figure,
    moment, system_figure, search, uncertain;
extern const Level method, declaration, parameter, unknown, requirement, claim, cost;
extern const Level component, map, loop, output, flow_set, state, log_plant, log, log_output,
    measured_input, measured_times, event, lost, noise, sinusoid, timer;
}  // namespace keys

/// All levels of problem and method files, and the forms that have names in their tables.
std::span<const Level* const> problem_levels();
std::span<const NamedForm> problem_forms();

/// The levels of gain files; the first is that of the document.
std::span<const Level* const> gain_file_levels();
std::span<const NamedForm> gain_file_forms();

}  // namespace gainsmith::io
