#include "gainsmith/load.h"

#include <algorithm>
#include <utility>

#include "base/file.h"
#include "io/gains_json.h"
#include "methods/methods.h"
#include "model/bind.h"
#include "model/stated.h"

namespace gainsmith::app {

namespace {

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
  const model::Stated stated = model::state(instance, gains);
  if (gains.verdict == model::Verdict::yes) {
    for (const auto& unknown : stated.unknowns) require(unknown.name, unknown.shape);
    for (const auto& wanted : instance.design->gains) {
      const bool function =
          std::any_of(gains.gain_functions.begin(), gains.gain_functions.end(),
                      [&](const model::GainFunction& gain) { return gain.name == wanted.name; });
      if (!function) require(wanted.name, wanted.shape);
    }
  }
  for (const auto& [name, value] : gains.parameters) {
    const auto known = instance.values.find(name);
    if (known == instance.values.end() || known->second != value)
      throw InputError({file},
                       "parameters." + name + " differs from the problem that the file states");
  }
}

}  // namespace

io::MethodLibrary built_in_methods() {
  return {[](const std::string& name) { return methods::find(name); }, methods::names()};
}

model::Instance load_problem(const std::filesystem::path& path,
                             const std::function<void(model::Problem&)>& add) {
  model::Problem problem = io::parse_problem(read_text(path), path.string(), built_in_methods());
  if (add) add(problem);
  return model::bind(problem);
}

LoadedGains load_gains(const std::filesystem::path& path) {
  model::Gains gains = io::parse_gains(read_text(path), path.string());
  model::Instance stated = model::bind(io::stated_problem(gains, path.string()), gains.searched);
  check_complete(gains, stated, path.string());
  return {std::move(gains), std::move(stated)};
}

}  // namespace gainsmith::app
