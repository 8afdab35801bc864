#include "io/schema/schema.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "gainsmith/commands.h"

namespace gainsmith::app {

namespace {

ExitCode print_schema(const std::string& kind) {
  const io::Json schema = kind == "problem"  ? io::problem_schema()
                          : kind == "method" ? io::method_schema()
                                             : io::gain_file_schema();
  fmt::print("{}", io::to_text(schema));
  return ExitCode::yes;
}

}  // namespace

Command schema_command() {
  auto kind = std::make_shared<std::string>();
  return {"schema",
          "Print the JSON schema of problem, method or gain files, by which editors check them",
          {Option("kind", *kind, "problem, method or gains")
               .required()
               .one_of({"problem", "method", "gains"})},
          "Examples:\n"
          "  gainsmith schema problem > problem.schema.json\n"
          "  # yaml-language-server: $schema=problem.schema.json   (first line of a problem)",
          [kind] { return print_schema(*kind); },
          false};
}

}  // namespace gainsmith::app
