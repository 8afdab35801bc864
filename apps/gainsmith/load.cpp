#include "gainsmith/load.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/file.h"
#include "base/nearest.h"
#include "base/number.h"
#include "bind/bind.h"
#include "bind/instance.h"
#include "bind/stated.h"
#include "design/optimize.h"
#include "design/synthesize.h"
#include "gainsmith/search_wanted.h"
#include "io/json/gains_json.h"
#include "methods/methods.h"
#include "model/stated.h"

namespace gainsmith::app {

namespace {

/// InputError when the name of a matrix is none of the method's.
void refuse_unknown(const std::string& name, const std::vector<std::string>& known,
                    const std::string& key, const std::string& file) {
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw InputError({file}, key + ": unknown name '" + name + "'" + suggestion(name, known));
}

void refuse_unknown(const model::NamedMatrices& matrices, const std::vector<std::string>& known,
                    const std::string& key, const std::string& file) {
  for (const auto& [name, value] : matrices) refuse_unknown(name, known, key, file);
}

/// InputError when a file has a matrix that is none of the method's, or when one that says yes
/// lacks a matrix of the method, or has another shape or parameter.
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
  const model::Stated stated = bind::state(instance, gains);
  std::vector<std::string> known;
  for (const auto& wanted : instance.design->gains) known.push_back(wanted.name);
  refuse_unknown(gains.gains, known, "gains", file);
  for (const model::GainFunction& function : gains.gain_functions)
    refuse_unknown(function.name, known, "gain_functions", file);
  known.clear();
  for (const auto& unknown : stated.unknowns) known.push_back(unknown.name);
  refuse_unknown(gains.unknowns, known, "unknowns", file);
  known.clear();
  for (const auto& shown : instance.design->report) known.push_back(shown.name);
  refuse_unknown(gains.report, known, "report", file);
  for (const auto& [shown, reason] : gains.not_computed)
    refuse_unknown(shown, known, "not_computed", file);
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
    const auto stated_value = instance.values.find(name);
    if (stated_value == instance.values.end() || stated_value->second != value)
      throw InputError({file},
                       "parameters." + name + " differs from the problem that the file states");
  }
}

/// InputError when a file whose verdict is not yes has no gains.
void refuse_without_gains(const model::Gains& gains, const model::Design& design,
                          const std::string& file) {
  if (gains.verdict == model::Verdict::yes || design.gains.empty() || !gains.gains.empty() ||
      !gains.gain_functions.empty())
    return;
  throw InputError({file}, "the verdict is " + std::string(to_string(gains.verdict)) +
                               ": the file has no gains; 'gainsmith explain' of its "
                               "problem says why, 'gainsmith certify' proves a no");
}

/// The scalars that the search of a file set.
std::vector<std::string> scalars_of(const model::SearchRecord& search) {
  std::vector<std::string> scalars = search.over;
  for (const std::string goal : {"largest ", "smallest "})
    if (search.figure.starts_with(goal)) scalars.push_back(search.figure.substr(goal.size()));
  return scalars;
}

/// InputError for values under `searched` that no search of the file set.
void check_searched(const model::Gains& gains, const std::string& file) {
  constexpr double kDigits = 1e-6;
  for (const auto& [name, value] : gains.searched) {
    if (!gains.search)
      throw InputError({file}, "searched." + name +
                                   ": no search set it, the file has no 'search'; a value that is "
                                   "chosen belongs into the problem");
    const model::SearchRecord& search = *gains.search;
    const std::vector<std::string> scalars = scalars_of(search);
    const auto found = std::find(scalars.begin(), scalars.end(), name);
    if (found == scalars.end())
      throw InputError({file}, "searched." + name + ": the search of this file did not set it" +
                                   suggestion(name, scalars));
    const bool is_figure = static_cast<std::size_t>(found - scalars.begin()) >= search.over.size();
    if (is_figure && search.value &&
        !(std::abs(value - *search.value) <= kDigits * std::abs(*search.value)))
      throw InputError({file},
                       "searched." + name + " = " + brief(value) +
                           " is not what the search found: search.value = " + brief(*search.value));
  }
}

bool is_gain_text(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (begin == std::string::npos || text[begin] != '{') return false;
  return text.find("\"gainsmith\"", begin) < begin + 20;  // its first key
}

/// "T2=0.8": T2 and 0.8.
std::vector<model::Setting> settings(const std::vector<std::string>& set) {
  std::vector<model::Setting> result;
  for (const std::string& text : set) {
    const std::size_t equals = text.find('=');
    const std::size_t begin = text.find_first_not_of(' ');
    if (equals == std::string::npos || begin == equals)
      throw InputError({"--set"}, "expected NAME=VALUE, not '" + text + "'");
    const std::size_t end = text.find_last_not_of(' ', equals - 1);
    result.push_back({text.substr(begin, end + 1 - begin), text.substr(equals + 1)});
  }
  return result;
}

}  // namespace

void refuse_without_campaign(const model::Design& design, const std::string& file) {
  if (!design.no_campaign.empty())
    throw InputError({file}, "there is no campaign: " + design.no_campaign);
  if (!design.dynamics)
    throw InputError({file},
                     "there is nothing to simulate: the method has no dynamics; a plant and an "
                     "observer beside its gains make a simulation");
  if (!model::ends(design))
    throw InputError({file},
                     "the problem gives no campaign; it needs 'campaign: {horizon: ...}': how long "
                     "a run is");
}

Option set_option(std::vector<std::string>& set) {
  return Option(
      "--set", set,
      "NAME=VALUE: this value for a datum, a parameter, a definition, gain_bound or margin of "
      "the problem, spelt as there; may be repeated");
}

io::MethodLibrary built_in_methods() {
  return {[](const std::string& name) { return methods::find(name); }, methods::names()};
}

bool is_gain_file(const std::filesystem::path& path) {
  std::error_code none;
  const bool is_text = path == "-" || (std::filesystem::exists(path, none) &&
                                       !std::filesystem::is_directory(path, none));
  return is_text && is_gain_text(read_text(path));
}

std::function<void(model::Problem&)> effort(const std::string& word) {
  return [word](model::Problem& problem) {
    if (!word.empty()) problem.synthesis.full_effort = word == "full";
  };
}

model::Instance load_problem(const std::filesystem::path& path, const std::vector<std::string>& set,
                             const std::function<void(model::Problem&)>& add) {
  const std::string text = read_text(path);
  if (is_gain_text(text))
    throw InputError({path.string()},
                     "this is a gain file; expected a problem in YAML. 'gainsmith verify' and "
                     "'gainsmith simulate' read gain files");
  model::Problem problem =
      io::parse_problem(text, path.string(), built_in_methods(), settings(set));
  if (add) add(problem);
  model::Instance instance = bind::bind(problem);
  bind::refuse_free_unknowns(*instance.design);
  return instance;
}

model::Gains read_gains(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (begin != std::string::npos && text[begin] != '{')
    throw InputError({path.string()},
                     "this is no gain file; expected the JSON that 'gainsmith synth -o' writes");
  return io::parse_gains(text, path.string());
}

LoadedGains load_gains(const std::filesystem::path& path) {
  model::Gains gains = read_gains(path);
  check_searched(gains, path.string());
  model::Instance stated = bind::bind(io::stated_problem(gains, path.string()), gains.searched);
  check_complete(gains, stated, path.string());
  refuse_without_gains(gains, *stated.design, path.string());
  return {std::move(gains), std::move(stated)};
}

namespace {

/// The gain file at `path`; nothing for a problem file.
std::optional<LoadedGains> load_if_gains(const std::filesystem::path& path,
                                         const std::vector<std::string>& set) {
  const std::string text = read_text(path);
  const std::size_t begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  // A problem may be JSON too.
  const bool is_problem = begin != std::string::npos &&
                          (text[begin] != '{' ||
                           (!is_gain_text(text) && text.find("\"problem\"") != std::string::npos &&
                            text.find("\"verdict\"") == std::string::npos));
  if (is_problem) return std::nullopt;
  if (!set.empty())
    throw InputError({"--set"},
                     "the problem of a gain file stays as it was solved; set values "
                     "when it is synthesized, or in a problem without unknowns");
  return load_gains(path);
}

}  // namespace

LoadedGains load_run(const std::filesystem::path& path, const std::vector<std::string>& set) {
  if (auto loaded = load_if_gains(path, set)) {
    refuse_without_campaign(*loaded->stated.design, path.string());
    return std::move(*loaded);
  }
  const model::Instance instance = load_problem(path, set);
  if (!instance.design->unknowns.empty() || !instance.design->open.empty())
    throw InputError({path.string()},
                     "the gains of this problem are not known yet: 'gainsmith synth " +
                         model::problem_words(path.string(), instance.design->statement.settings) +
                         " -o gains.json' first, then simulate or verify gains.json");
  refuse_without_campaign(*instance.design, path.string());
  model::Gains gains = design::synthesize(instance, {});
  if (gains.verdict == model::Verdict::no)
    throw InputError({path.string()}, "its inequalities do not hold: 'gainsmith synth " +
                                          path.string() + "' says why");
  return {std::move(gains), instance};
}

LoadedGains load_designed(const std::filesystem::path& path, const std::vector<std::string>& set) {
  if (auto loaded = load_if_gains(path, set)) return std::move(*loaded);
  const model::Instance instance = load_problem(path, set);
  model::Gains gains = design::synthesize_searched(instance, wanted_search(instance), 1, {});
  return {gains, bind::evaluate(instance.design, gains.searched)};
}

}  // namespace gainsmith::app
