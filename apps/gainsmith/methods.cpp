#include "methods/methods.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "base/nearest.h"
#include "gainsmith/commands.h"
#include "io/json_text.h"
#include "io/method_yaml.h"

namespace gainsmith::app {

namespace {

struct MethodsOptions {
  std::string name;
  bool json = false;
};

io::Json description(const model::Method& method) {
  io::Json data = io::Json::object();
  for (const auto& datum : method.data)
    data[datum.name] = {
        {"shape", datum.shape.text}, {"required", !datum.fallback}, {"help", datum.help}};
  io::Json parameters = io::Json::object();
  for (const auto& parameter : method.parameters)
    parameters[parameter.name] = {
        {"default", parameter.fallback ? io::Json(parameter.fallback->text->str()) : io::Json()},
        {"help", parameter.help}};
  return {{"method", method.name},
          {"summary", method.summary},
          {"source", method.source},
          {"data", data},
          {"parameters", parameters}};
}

ExitCode show(const MethodsOptions& options) {
  io::Json list = io::Json::array();
  for (const methods::Text& entry : methods::all()) {
    const model::Method method =
        io::parse_method(std::string(entry.text), "method " + std::string(entry.name));
    if (options.json) {
      list.push_back(description(method));
    } else {
      fmt::print("{:<32} {}\n", method.name, method.summary);
    }
  }
  if (options.json) fmt::print("{}", io::to_text(list));
  return ExitCode::yes;
}

ExitCode show_one(const MethodsOptions& options) {
  const auto text = methods::find(options.name);
  if (!text)
    throw InputError(
        {}, "unknown method '" + options.name + "'" + suggestion(options.name, methods::names()));
  if (options.json) {
    fmt::print("{}", io::to_text(description(io::parse_method(*text, "method " + options.name))));
  } else {
    fmt::print("{}", *text);
  }
  return ExitCode::yes;
}

}  // namespace

void add_methods(CLI::App& program, ExitCode& exit) {
  auto options = std::make_shared<MethodsOptions>();
  CLI::App* command = program.add_subcommand("methods", "List the methods, or print one as text");
  command->add_option("name", options->name, "print this method");
  command->add_flag("--json", options->json, "print as JSON");
  command->footer(
      "Examples:\n"
      "  gainsmith methods\n"
      "  gainsmith methods sampled-data-hybrid");
  command->callback(
      [options, &exit] { exit = options->name.empty() ? show(*options) : show_one(*options); });
}

}  // namespace gainsmith::app
