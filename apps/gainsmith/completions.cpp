#include "gainsmith/completions.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "gainsmith/commands.h"
#include "model/stated_file.h"

namespace gainsmith::app {

namespace {

constexpr const char* kHelp = "print help";
constexpr const char* kHelpCommand = "print the help of a command";

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> command_names(const Program& program) {
  std::vector<std::string> names;
  for (const Command& command : program.commands) names.push_back(command.name);
  return names;
}

/// A text inside [brackets] of zsh.
std::string bracketed(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::string zsh_option(const Option& option) {
  const std::vector<std::string> names = dashed_names(option);
  const std::vector<std::string> words = offered_words(option);
  const std::string action = words.empty() ? "_files" : fmt::format("({})", fmt::join(words, " "));
  if (names.empty()) {
    const bool many = std::holds_alternative<std::vector<std::string>*>(option.target);
    return model::quoted(fmt::format("{}:{}:{}", many ? "*" : "", option.name, action));
  }
  const std::string text =
      "[" + bracketed(option.text) + "]" + (takes_value(option) ? ":value:" + action : "");
  std::string result;
  for (const std::string& name : names) {
    const bool again = std::holds_alternative<std::vector<std::string>*>(option.target);
    result += (result.empty() ? "" : " ") + model::quoted((again ? "*" : "") + name + text);
  }
  return result;
}

std::string fish_option(const std::string& command, const Option& option) {
  const std::string here = model::quoted("__fish_seen_subcommand_from " + command);
  const std::vector<std::string> words = offered_words(option);
  std::string line = fmt::format("complete -c gainsmith -n {}", here);
  const std::vector<std::string> names = dashed_names(option);
  if (names.empty() && words.empty()) return "";
  for (const std::string& name : names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!names.empty() && takes_value(option)) line += " -r";
  if (!words.empty()) line += " -f -a " + model::quoted(joined(words));
  return line + " -d " + model::quoted(option.text) + "\n";
}

ExitCode print_completions(const std::string& shell) {
  const Program program = all_commands();
  fmt::print("{}", shell == "bash"  ? bash_completions(program)
                   : shell == "zsh" ? zsh_completions(program)
                                    : fish_completions(program));
  return ExitCode::yes;
}

}  // namespace

std::vector<std::string> dashed_names(const Option& option) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < option.name.size();) {
    const std::size_t end = std::min(option.name.find(',', begin), option.name.size());
    if (option.name[begin] == '-') names.push_back(option.name.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

bool takes_value(const Option& option) { return !std::holds_alternative<bool*>(option.target); }

std::vector<std::string> offered_words(const Option& option) {
  return option.choices.empty() ? option.choices_offered : option.choices;
}

std::string bash_completions(const Program& program) {
  std::string options;
  std::string values;
  Patience patience;
  for (const Command& command : program.commands) {
    std::vector<std::string> names = {"--help"};
    std::string words;
    for (const Option& option : options_of(command, patience)) {
      const std::vector<std::string> dashed = dashed_names(option);
      names.insert(names.end(), dashed.begin(), dashed.end());
      const std::string offered = joined(offered_words(option));
      if (dashed.empty()) words = offered;
      for (const std::string& name : dashed)
        if (!offered.empty())
          values += fmt::format("    '{} {}') words='{}' ;;\n", command.name, name, offered);
    }
    options +=
        fmt::format("    {}) options='{}' words='{}' ;;\n", command.name, joined(names), words);
  }
  return fmt::format(
      "# Completion of gainsmith in bash, made by 'gainsmith completions bash'.\n"
      "_gainsmith() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} options "
      "words\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{0} help --help --version' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{1}"
      "    help) options='' words='{0}' ;;\n"
      "    *) return ;;\n"
      "  esac\n"
      "  [[ $word == -* ]] && words=$options\n"
      "  case \"${{COMP_WORDS[1]}} $before\" in\n{2}"
      "  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "}}\n"
      "complete -o default -F _gainsmith gainsmith\n",
      joined(command_names(program)), options, values);
}

std::string zsh_completions(const Program& program) {
  std::string commands;
  std::string cases;
  Patience patience;
  for (const Command& command : program.commands) {
    commands += "    " + model::quoted(command.name + ":" + bracketed(command.text)) + "\n";
    cases += fmt::format("    {}) _arguments '--help[{}]'", command.name, kHelp);
    for (const Option& option : options_of(command, patience))
      cases += " \\\n      " + zsh_option(option);
    cases += " ;;\n";
  }
  commands += "    " + model::quoted(std::string("help:") + kHelpCommand) + "\n";
  cases += "    help) _arguments " +
           model::quoted(fmt::format("1:command:({})", joined(command_names(program)))) + " ;;\n";
  return fmt::format(
      "#compdef gainsmith\n"
      "# Completion of gainsmith in zsh, made by 'gainsmith completions zsh'.\n"
      "_gainsmith() {{\n"
      "  local -a commands\n"
      "  commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    _arguments '--help[{}]' '--version[print the version]'\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n{}"
      "  esac\n"
      "}}\n"
      "if [ \"$funcstack[1]\" = _gainsmith ]; then _gainsmith; else compdef _gainsmith gainsmith; "
      "fi\n",
      commands, kHelp, cases);
}

std::string fish_completions(const Program& program) {
  std::string text =
      "# Completion of gainsmith in fish, made by 'gainsmith completions fish'.\n"
      "complete -c gainsmith -n __fish_use_subcommand -l version -d 'print the version'\n" +
      fmt::format("complete -c gainsmith -l help -d '{}'\n", kHelp);
  Patience patience;
  for (const Command& command : program.commands) {
    text += fmt::format("complete -c gainsmith -n __fish_use_subcommand -f -a {} -d {}\n",
                        command.name, model::quoted(command.text));
    for (const Option& option : options_of(command, patience))
      text += fish_option(command.name, option);
  }
  text += fmt::format(
      "complete -c gainsmith -n __fish_use_subcommand -f -a help -d '{}'\n"
      "complete -c gainsmith -n '__fish_seen_subcommand_from help' -f -a '{}'\n",
      kHelpCommand, joined(command_names(program)));
  return text;
}

Command completions_command() {
  auto shell = std::make_shared<std::string>();
  return {"completions",
          "Print the script that completes commands, options and words in a shell",
          {Option("shell", *shell, "bash, zsh or fish").required().one_of({"bash", "zsh", "fish"})},
          "Example:\n"
          "  source <(gainsmith completions bash)",
          [shell] { return print_completions(*shell); },
          false};
}

}  // namespace gainsmith::app
