#include "gainsmith/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <type_traits>

#include "base/nearest.h"

namespace gainsmith::app {

namespace {

template <typename Value, typename... Types>
constexpr bool is_one_of = (std::is_same_v<Value, Types> || ...);

/// Digits only: CLI11 itself would take -1 for the largest unsigned number.
std::string whole_number_error(const std::string& text) {
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::string() : "expected a whole number, at least 0, not '" + text + "'";
}

CLI::Range validator(const Option::Range<double>& range) {
  const bool endless = range.first == 0 && range.second == std::numeric_limits<double>::max();
  return endless ? CLI::NonNegativeNumber : CLI::Range(range.first, range.second);
}

template <typename Whole>
CLI::Range validator(const Option::Range<Whole>& range) {
  return {range.first, range.second};
}

void add_checks(CLI::Option& added, const Option& option) {
  std::visit(
      [&](const auto& range) {
        if constexpr (!is_one_of<std::decay_t<decltype(range)>, std::monostate>)
          added.check(validator(range));
      },
      option.range);
  if (!option.choices.empty()) added.check(CLI::IsMember(option.choices));
  if (option.check) added.check(option.check);
}

/// Declares the option by its target's type.
template <typename Value>
CLI::Option& add_option(CLI::App& command, const Option& option, Value& value) {
  if constexpr (is_one_of<Value, bool>) {
    return *command.add_flag(option.name, value, option.text);
  } else {
    CLI::Option& added = *command.add_option(option.name, value, option.text);
    if constexpr (is_one_of<Value, int, unsigned, std::uint64_t, double, std::string>)
      added.capture_default_str();
    if constexpr (is_one_of<Value, std::uint64_t, std::optional<std::uint64_t>>)
      if (option.range.index() == 0) added.check(whole_number_error, "WHOLE");
    if constexpr (is_one_of<Value, std::vector<std::string>>)
      if (!added.get_positional() && !option.count) added.allow_extra_args(false);
    return added;
  }
}

void add_command(CLI::App& program, const Command& command, ExitCode& exit) {
  CLI::App& added = *program.add_subcommand(command.name, command.text);
  for (const Option& option : command.options) {
    CLI::Option& one =
        std::visit([&](auto* value) -> CLI::Option& { return add_option(added, option, *value); },
                   option.target);
    add_checks(one, option);
    one.required(option.is_required);
    if (option.count) one.expected(*option.count);
    for (const std::string& name : option.excluded) one.excludes(added.get_option(name));
  }
  added.footer(command.footer);
  added.callback([&command, &exit] { exit = command.work(); });
}

/// CLI11 takes an unknown first word for a missing subcommand.
void refuse_unknown_word(const Program& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const Command& command : program.commands) names.push_back(command.name);
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw InputError(
      {}, "unknown subcommand '" + std::string(argv[1]) + "'" + suggestion(argv[1], names));
}

}  // namespace

ExitCode run(const Program& program, int argc, char** argv) {
  ExitCode exit = ExitCode::yes;
  CLI::App parser(program.text, program.name);
  parser.set_version_flag("--version", program.version);
  parser.require_subcommand(1);
  parser.footer(program.footer);
  for (const Command& command : program.commands) add_command(parser, command, exit);
  refuse_unknown_word(program, argc, argv);
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    // Help and version are such stops too, with the code 0.
    return parser.exit(stop) == 0 ? ExitCode::yes : ExitCode::bad_input;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw InputError({}, "cannot write to standard output");
  return exit;
}

}  // namespace gainsmith::app
