#include "gainsmith/load.h"

#include <algorithm>
#include <utility>

#include "base/file.h"
#include "io/gains_json.h"
#include "methods/methods.h"
#include "model/stated.h"

namespace gainsmith::app {

namespace {

Loaded checked(model::Problem problem, const model::Overrides& overrides = {}) {
  Loaded loaded{std::make_unique<model::Problem>(std::move(problem)), {}};
  loaded.instance = model::make_instance(*loaded.problem, overrides);
  model::check_everything(loaded.instance);
  return loaded;
}

/// InputError when a file that says yes lacks a matrix of the method, or has another shape or
/// parameter.
void check_complete(const model::Gains& gains, const model::Instance& instance,
                    const std::string& file) {
  const auto require = [&](const std::string& name, expr::Shape shape) {
    const numbers::Matrix* found = gains.find(name);
    if (found == nullptr)
      throw InputError({file}, "the verdict is yes, but " + name + " is missing");
    const expr::Shape actual{static_cast<int>(found->rows()), static_cast<int>(found->cols())};
    if (actual != shape)
      throw InputError({file},
                       name + " is " + to_string(actual) + "; expected " + to_string(shape));
  };
  model::state(instance, gains);  // throws when a function in it does not fit
  if (gains.verdict == model::Verdict::yes) {
    for (const auto& unknown : model::with_functions(instance, gains).unknowns)
      require(unknown.name, unknown.shape);
    for (const auto& [name, shape] : model::gain_shapes(instance)) {
      const bool function = std::any_of(
          gains.gain_functions.begin(), gains.gain_functions.end(),
          [&, wanted = name](const model::GainFunction& gain) { return gain.name == wanted; });
      if (!function) require(name, shape);
    }
  }
  for (const auto& [name, value] : gains.parameters) {
    const auto stated = instance.parameters.find(name);
    if (stated == instance.parameters.end() || stated->second != value)
      throw InputError({file},
                       "parameters." + name + " differs from the problem that the file states");
  }
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
  Loaded stated = checked(io::stated_problem(gains, path.string()), gains.searched);
  check_complete(gains, stated.instance, path.string());
  return {std::move(gains), std::move(stated)};
}

}  // namespace gainsmith::app
