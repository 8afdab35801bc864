#include "gainsmith/load.h"

#include <utility>

#include "base/file.h"
#include "io/gains_json.h"
#include "methods/methods.h"

namespace gainsmith::app {

namespace {

Loaded checked(model::Problem problem) {
  Loaded loaded{std::make_unique<model::Problem>(std::move(problem)), {}};
  loaded.instance = model::make_instance(*loaded.problem);
  model::check_everything(loaded.instance);
  return loaded;
}

}  // namespace

io::MethodLibrary built_in_methods() {
  return {[](const std::string& name) { return methods::find(name); }, methods::names()};
}

Loaded load_problem(const std::filesystem::path& path) {
  return checked(io::parse_problem(read_text(path), path.string(), built_in_methods()));
}

LoadedGains load_gains(const std::filesystem::path& path) {
  model::Gains gains = io::parse_gains(read_text(path), path.string());
  Loaded stated = checked(io::stated_problem(gains, path.string()));
  return {std::move(gains), std::move(stated)};
}

}  // namespace gainsmith::app
