#include "gainsmith/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <vector>

#include "gainsmith/commands.h"
#include "gainsmith/completions.h"

namespace gainsmith::app {

namespace {

/// A text of roff: its control characters represent themselves.
std::string roff(std::string_view text) {
  std::string result;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    at_start = c == '\n';
  }
  return result;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return text;
}

/// What represents the value of an option.
std::string value_name(const Option& option) {
  if (!option.value_name.empty()) return option.value_name;
  if (!option.choices.empty()) return fmt::format("{}", fmt::join(option.choices, "|"));
  return std::visit(
      [](auto* value) -> std::string {
        using Value = std::remove_pointer_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>)
          return "NUMBER";
        else if constexpr (std::is_same_v<Value, std::string> ||
                           std::is_same_v<Value, std::vector<std::string>>)
          return "TEXT";
        else
          return "WHOLE";
      },
      option.target);
}

std::string range_text(const Option& option) {
  return std::visit(
      [](const auto& range) -> std::string {
        if constexpr (std::is_same_v<std::decay_t<decltype(range)>, std::monostate>)
          return "";
        else
          return fmt::format(" ({} to {})", range.first, range.second);
      },
      option.range);
}

std::string paragraph(const Option& option) {
  const std::vector<std::string> names = dashed_names(option);
  std::string head;
  for (const std::string& name : names)
    head += (head.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  if (names.empty()) head = "\\fI" + roff(upper(option.name)) + "\\fR";
  if (!names.empty() && takes_value(option)) head += " \\fI" + roff(value_name(option)) + "\\fR";
  return ".TP\n" + head + "\n" + roff(option.text + range_text(option)) + "\n";
}

std::string section(const Program& program, const Command& command) {
  std::string synopsis = "\\fB" + program.name + " " + command.name + "\\fR";
  std::string arguments;
  std::string options;
  Patience patience;
  for (const Option& option : options_of(command, patience)) {
    if (!dashed_names(option).empty()) {
      options += paragraph(option);
      continue;
    }
    const bool many = std::holds_alternative<std::vector<std::string>*>(option.target);
    const std::string name = "\\fI" + roff(upper(option.name)) + "\\fR" + (many ? "..." : "");
    synopsis += option.is_required ? " " + name : " [" + name + "]";
    arguments += paragraph(option);
  }
  return ".SS " + program.name + " " + command.name + "\n" + synopsis +
         " [\\fIOPTIONS\\fR]\n.PP\n" + roff(command.text) + ".\n" + arguments + options +
         ".PP\n.nf\n" + roff(command.footer) + "\n.fi\n";
}

}  // namespace

std::string manual_page(const Program& program) {
  const std::size_t colon = program.text.find(": ");
  std::string page = ".TH " + upper(program.name) + " 1 \"\" \"" + program.version +
                     "\" \"User commands\"\n.SH NAME\n" + program.name + " \\- " +
                     roff(program.text.substr(colon + 2)) + "\n.SH SYNOPSIS\n\\fB" + program.name +
                     "\\fR \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n.br\n\\fB" + program.name +
                     "\\fR [\\fICOMMAND\\fR] \\fB\\-\\-help\\fR\n.br\n\\fB" + program.name +
                     " \\-\\-version\\fR\n.SH COMMANDS\n";
  for (const Command& command : program.commands) page += section(program, command);
  return page + ".SH EXIT STATUS\n.nf\n" + roff(program.footer) + "\n.fi\n";
}

Command manual_command() {
  return {"manual",
          "Print the manual page, for man",
          {},
          "Example:\n"
          "  gainsmith manual | man -l -",
          [] {
            fmt::print("{}", manual_page(all_commands()));
            return ExitCode::yes;
          },
          false};
}

}  // namespace gainsmith::app
