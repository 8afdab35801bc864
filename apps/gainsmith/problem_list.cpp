#include "gainsmith/problem_list.h"

#include <system_error>

#include "base/error.h"
#include "base/file.h"
#include "io/json/json_reader.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

fs::path list_of(const fs::path& folder) { return folder / "problems.json"; }

}  // namespace

void write_problem_list(const fs::path& folder, const std::vector<std::string>& names) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError({folder.string()}, "cannot make this folder: " + error.message());
  write_atomically(list_of(folder), io::to_text({{"problems", names}}));
}

std::vector<std::string> read_problem_list(const fs::path& folder) {
  const fs::path file = list_of(folder);
  std::error_code none;
  if (!fs::exists(file, none)) return {};
  const io::Json document = io::parse_json(read_text(file), file.string());
  std::vector<std::string> names;
  for (const io::JsonReader& name : io::JsonReader(document, file.string()).at("problems").items())
    names.push_back(name.text());
  return names;
}

}  // namespace gainsmith::app
