#include "methods/methods.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "gainsmith/commands.h"
#include "io/json/json_text.h"
#include "io/starting_problem.h"
#include "io/yaml/method_yaml.h"
#include "io/yaml/problem_yaml.h"
#include "model/words.h"

namespace gainsmith::app {

namespace {

struct MethodsOptions {
  std::string name;
  bool own = false;
  bool json = false;
};

io::Json description(const model::Method& method) {
  io::Json data = io::Json::object();
  for (const auto& datum : method.data) {
    data[datum.name] = {
        {"shape", datum.shape.text}, {"required", !datum.fallback}, {"help", datum.help}};
    for (const auto& argument : datum.arguments)
      data[datum.name]["of"][argument.name] = argument.shape.text;
  }
  io::Json parameters = io::Json::object();
  for (const auto& parameter : method.parameters)
    parameters[parameter.name] = {
        {"default", parameter.fallback ? io::Json(parameter.fallback->text->str()) : io::Json()},
        {"help", parameter.help}};
  return {{"method", method.name},   {"task", method.task},       {"summary", method.summary},
          {"source", method.source}, {"example", method.example}, {"data", data},
          {"parameters", parameters}};
}

model::Method read(const methods::Text& text) {
  return io::parse_method(std::string(text.text), model::method_file(text.name));
}

/// Each task with its methods, and with the problem to begin with.
void print_by_task() {
  for (const std::string& task : model::tasks()) {
    fmt::print("{}\n", task);
    for (const methods::Text& text : methods::all()) {
      const model::Method method = read(text);
      if (method.task == task)
        fmt::print("  {:<30} {} (problems/{}.yaml)\n", method.name, method.summary, method.example);
    }
  }
  fmt::print("'gainsmith init METHOD > mine.yaml' writes a problem to begin with.\n");
}

ExitCode show(const MethodsOptions& options) {
  if (!options.json) {
    print_by_task();
    return ExitCode::yes;
  }
  io::Json list = io::Json::array();
  for (const methods::Text& text : methods::all()) list.push_back(description(read(text)));
  fmt::print("{}", io::to_text(list));
  return ExitCode::yes;
}

/// InputError for a name that no method has.
std::string text_of(const std::string& name) {
  if (auto text = methods::find(name)) return *text;
  throw InputError({}, io::unknown_method(name, methods::names()));
}

ExitCode show_one(const MethodsOptions& options) {
  const std::string text = text_of(options.name);
  if (options.json) {
    fmt::print("{}",
               io::to_text(description(io::parse_method(text, model::method_file(options.name)))));
  } else {
    fmt::print("{}", text);
  }
  return ExitCode::yes;
}

ExitCode init(const MethodsOptions& options) {
  const std::string own = text_of(options.name);
  const model::Method method = io::parse_method(own, model::method_file(options.name));
  const std::string text =
      io::starting_problem(method, methods::example(options.name), options.own ? own : "");
  if (options.json) {
    fmt::print("{}", io::to_text({{"method", options.name}, {"problem", text}}));
  } else {
    fmt::print("{}", text);
  }
  return ExitCode::yes;
}

}  // namespace

Command methods_command() {
  auto options = std::make_shared<MethodsOptions>();
  return {"methods",
          "List the methods by task, or print one as text",
          {Option("name", options->name, "print this method").suggests(methods::names()),
           Option("--json", options->json, "print as JSON")},
          "Examples:\n"
          "  gainsmith methods\n"
          "  gainsmith methods sampled-data-hybrid",
          [options] { return options->name.empty() ? show(*options) : show_one(*options); },
          false};
}

Command init_command() {
  auto options = std::make_shared<MethodsOptions>();
  return {"init",
          "Write a problem of a method to begin with: data with comments, and it runs as it is",
          {Option("method", options->name, "the method; 'gainsmith methods' lists them")
               .required()
               .suggests(methods::names()),
           Option("--own", options->own,
                  "with the method's text in the problem: to add noise, outputs or claims to it"),
           Option("--json", options->json, "print as JSON")},
          "Examples:\n"
          "  gainsmith init lqr > mine.yaml\n"
          "  gainsmith run mine.yaml\n"
          "  gainsmith init nonlinear-observer --own > noisy.yaml",
          [options] { return init(*options); },
          false};
}

}  // namespace gainsmith::app
