#include "gainsmith/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <sstream>
#include <type_traits>

#include "base/nearest.h"
#include "base/number.h"
#include "gainsmith/whole_number.h"

namespace gainsmith::app {

namespace {

template <typename Value, typename... Types>
constexpr bool is_one_of = (std::is_same_v<Value, Types> || ...);

/// "1e4" becomes "10000".
std::string write_in_digits(std::string& text) {
  if (const auto value = parse_whole(text)) text = std::to_string(*value);
  return {};
}

/// CLI11 itself would take -1, and all numbers that are too large, for the largest unsigned number.
std::string whole_number_error(const std::string& text) {
  if (parse_whole(text)) return {};
  return "expected a whole number from 0 to 18446744073709551615 (2^64 - 1), not '" + text + "'";
}

CLI::Validator validator(const Option::Range<double>& range) {
  constexpr int kDigits = 12;
  const std::string ends = brief(range.first, kDigits) + " to " + brief(range.second, kDigits);
  return {[range, ends](const std::string& text) -> std::string {
            const auto value = parse_decimal(text);
            if (value && range.first <= *value && *value <= range.second) return {};
            return "expected a number from " + ends + ", not '" + text + "'";
          },
          "NUMBER in [" + ends + "]"};
}

std::string seconds_error(const std::string& text) {
  const auto value = parse_decimal(text);
  if (value && *value > 0) return {};
  return "expected a positive number of seconds, such as 60 or 0.5, not '" + text + "'";
}

template <typename Whole>
CLI::Validator validator(const Option::Range<Whole>& range) {
  const std::string ends = std::to_string(range.first) + " to " + std::to_string(range.second);
  return {[range, ends](const std::string& text) -> std::string {
            const auto value = parse_whole(text);
            if (value && static_cast<std::uint64_t>(range.first) <= *value &&
                *value <= static_cast<std::uint64_t>(range.second))
              return {};
            return "expected a whole number from " + ends + ", not '" + text + "'";
          },
          "WHOLE in [" + ends + "]"};
}

void add_checks(CLI::Option& added, const Option& option) {
  std::visit(
      [&](const auto& range) {
        if constexpr (!is_one_of<std::decay_t<decltype(range)>, std::monostate>)
          added.check(validator(range));
      },
      option.range);
  if (!option.value_name.empty()) added.type_name(option.value_name);
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
    if constexpr (is_one_of<Value, int, unsigned, std::uint64_t, std::optional<int>,
                            std::optional<std::uint64_t>>)
      added.transform(CLI::Validator(write_in_digits, ""));
    if constexpr (is_one_of<Value, std::uint64_t, std::optional<std::uint64_t>>)
      if (option.range.index() == 0) added.check(whole_number_error, "WHOLE");
    // As of a variable of a script that is not set.
    if constexpr (is_one_of<Value, std::string, std::vector<std::string>>)
      added.check(CLI::Validator(
          [](const std::string& text) {
            return std::string(text.empty() ? "a value is missing" : "");
          },
          ""));
    if constexpr (is_one_of<Value, std::vector<std::string>>)
      if (!added.get_positional() && !option.count) added.allow_extra_args(false);
    return added;
  }
}

/// The work, or as much of it as was done before a stop.
ExitCode work_of(const Command& command) {
  ExitCode exit = ExitCode::undecided;
  try {
    exit = command.work();
  } catch (const Stopped&) {
    // Nothing is known that the command could tell.
  }
  end_work();
  if (const std::string text = stop_text(); !text.empty()) say("gainsmith: " + text + "\n");
  return exit;
}

void add_command(CLI::App& program, const Command& command, Patience& patience, ExitCode& exit) {
  CLI::App& added = *program.add_subcommand(command.name, command.text);
  for (const Option& option : options_of(command, patience)) {
    CLI::Option& one =
        std::visit([&](auto* value) -> CLI::Option& { return add_option(added, option, *value); },
                   option.target);
    add_checks(one, option);
    one.required(option.is_required);
    if (option.count) one.expected(*option.count);
    for (const std::string& name : option.excluded) one.excludes(added.get_option(name));
  }
  added.footer(command.footer);
  added.callback([&command, &patience, &exit] {
    if (command.computes) begin_work(patience);
    exit = work_of(command);
  });
}

/// "help synth" as "synth --help".
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin(), words.begin() + (words.size() > 1 && words[1] == "help" ? 2 : 1));
  words.emplace_back("--help");
  return words;
}

/// CLI11 takes an unknown first word for a missing subcommand.
void refuse_unknown_word(const Program& program, const std::string& word) {
  if (word.empty() || word[0] == '-') return;
  std::vector<std::string> names;
  for (const Command& command : program.commands) names.push_back(command.name);
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError({}, "unknown command '" + word + "'" + suggestion(word, names));
}

/// The nearest option of the command; the other commands that have it; or those that there are.
std::string advice_on_option(const Program& program, const std::string& word,
                             const std::vector<std::string>& known) {
  if (nearest(word, known)) return suggestion(word, known);
  std::string others;
  for (const Command& command : program.commands)
    for (const Option& option : command.options)
      if (("," + option.name + ",").find("," + word + ",") != std::string::npos)
        others += (others.empty() ? "" : ", ") + command.name;
  if (!others.empty()) return "; it is an option of " + others;
  const bool sets = std::find(known.begin(), known.end(), "--set") != known.end();
  return suggestion(word, known) +
         (sets ? "; '--set NAME=VALUE' changes a value of the problem" : "");
}

/// The first argument that nothing takes: an option rather than a value, which may belong to it.
std::string unknown_argument(const Program& program, const CLI::App& command) {
  const std::vector<std::string> left = command.remaining(true);
  const auto option = std::find_if(left.begin(), left.end(), [](const std::string& word) {
    return word.size() > 1 && word.starts_with('-');
  });
  if (option == left.end())
    return left.empty() ? "an argument too many" : "unexpected argument '" + left.front() + "'";
  std::vector<std::string> known;
  for (const CLI::Option* each : command.get_options())
    for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
  const std::string word = option->substr(0, option->find('='));
  return "unknown option '" + word + "'" + advice_on_option(program, word, known);
}

/// What the reader says, but of values that are missing: it names their type there.
std::string in_words(const CLI::App& command, const CLI::ParseError& error) {
  const std::string said = error.what();
  // A positional argument has no dashes, and its name says little.
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && !said.starts_with("-")) {
    const std::string name = said.substr(0, said.find(' '));
    if (const CLI::Option* option = command.get_option_no_throw(name); option != nullptr)
      return name + " is missing: " + option->get_description();
  }
  const std::size_t colon = said.find(": ");
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr || colon == said.npos)
    return said;
  const bool twice =
      said.find("[At Most") != said.npos || said.find("At Most 1 required") != said.npos;
  return said.substr(0, colon) + (twice ? ": given twice" : ": a value is missing");
}

/// What is wrong with the command line, and where help is.
std::string complaint(const Program& whole, const CLI::App& program, const CLI::ParseError& error) {
  const auto used = program.get_subcommands();
  const CLI::App& command = used.empty() ? program : *used.front();
  const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                       (used.empty() && !program.remaining().empty());
  const std::string name = program.get_name() + (used.empty() ? "" : " " + command.get_name());
  return (used.empty() ? "" : command.get_name() + ": ") +
         (unknown ? unknown_argument(whole, command) : in_words(command, error)) + " (see '" +
         name + " --help')";
}

}  // namespace

std::vector<Option> options_of(const Command& command, Patience& patience) {
  std::vector<Option> options = command.options;
  if (!command.computes) return options;
  options.push_back(Option("--time", patience.seconds,
                           "stop after so many seconds with what is known; no limit without it")
                        .named("SECONDS")
                        .checked(seconds_error));
  options.emplace_back("--progress", patience.progress,
                       "write every 10 s a line of JSON to standard error: what is done, and how "
                       "long the rest takes");
  return options;
}

ExitCode run(const Program& program, int argc, char** argv) {
  ExitCode exit = ExitCode::yes;
  Patience patience;
  CLI::App parser(program.text, program.name);
  parser.set_version_flag("--version", program.version);
  parser.require_subcommand(1);
  parser.footer(program.footer);
  std::vector<std::string> words = words_of(argc, argv);
  const std::string first = words.empty() ? "" : words.front();
  refuse_unknown_word(program, first);
  // The others would only cost time.
  const bool chosen = !first.empty() && first[0] != '-';
  for (const Command& command : program.commands)
    if (!chosen || command.name == first) add_command(parser, command, patience, exit);
  try {
    // It takes the words from the back.
    std::reverse(words.begin(), words.end());
    parser.parse(std::move(words));
  } catch (const CLI::ParseError& stop) {
    // Help and version are such stops too, with the code 0.
    if (stop.get_exit_code() != 0) throw InputError({}, complaint(program, parser, stop));
    std::ostringstream text;
    parser.exit(stop, text, text);
    std::fputs(text.str().c_str(), stdout);
  }
  finish_output();
  return exit;
}

}  // namespace gainsmith::app
