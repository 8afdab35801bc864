#include "methods/methods.h"

#include <fmt/format.h>

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

Command methods_command() {
  auto options = std::make_shared<MethodsOptions>();
  return {"methods",
          "List the methods, or print one as text",
          {Option("name", options->name, "print this method"),
           Option("--json", options->json, "print as JSON")},
          "Examples:\n"
          "  gainsmith methods\n"
          "  gainsmith methods sampled-data-hybrid",
          [options] { return options->name.empty() ? show(*options) : show_one(*options); },
          false};
}

}  // namespace gainsmith::app
