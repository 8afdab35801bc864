#include "gainsmith/picture_options.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "base/error.h"
#include "gainsmith/whole_number.h"

namespace gainsmith::app {

namespace {

/// The parts between the marks, without blanks at their ends.
std::vector<std::string> parts_of(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::istringstream stream(text + mark);
  for (std::string part; std::getline(stream, part, mark);) {
    const std::size_t first = part.find_first_not_of(" \t");
    const std::size_t last = part.find_last_not_of(" \t");
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

/// Names with a mark between them, of this number where one is given.
std::vector<std::string> names_of(const std::string& text, char mark, const char* option,
                                  std::optional<std::size_t> count, const std::string& expected) {
  std::vector<std::string> names = parts_of(text, mark);
  if ((count && names.size() != *count) ||
      std::any_of(names.begin(), names.end(), [](const auto& name) { return name.empty(); }))
    throw InputError({option}, "expected " + expected + ", not '" + text + "'");
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw InputError({option}, "'" + *name + "' is named twice");
  return names;
}

constexpr std::uint64_t kMostDrawn = 100;
constexpr std::uint64_t kMostCompared = 1000000;

/// "3" or "0:9".
void add_runs(const std::string& part, const std::string& text, bool compared,
              std::vector<std::uint64_t>& runs) {
  const std::uint64_t most = compared ? kMostCompared : kMostDrawn;
  const std::vector<std::string> ends = parts_of(part, ':');
  const auto first = parse_whole(ends.front()), last = parse_whole(ends.back());
  if (ends.size() > 2 || !first || !last || *last < *first)
    throw InputError({"--runs"},
                     "expected numbers of runs, such as 0,3,17 or 0:9, not '" + text + "'");
  if (*last - *first >= most || runs.size() + (*last - *first) >= most)
    throw InputError({"--runs"}, "at most " + std::to_string(most) + " runs are " +
                                     (compared ? "compared" : "drawn over each other") +
                                     ": name fewer of them; 'gainsmith verify --runs N --compare' "
                                     "has no such limit");
  for (std::uint64_t run = *first; run <= *last; ++run) runs.push_back(run);
}

void require_different(std::vector<std::uint64_t> runs) {
  std::sort(runs.begin(), runs.end());
  const auto twice = std::adjacent_find(runs.begin(), runs.end());
  if (twice != runs.end())
    throw InputError({"--runs"}, "run " + std::to_string(*twice) + " is named twice");
}

}  // namespace

bool PictureOptions::only_drawn() const {
  return !planes.empty() || !bands.empty() || !panels.empty();
}

RunView view_of(const PictureOptions& options, const model::Design& design) {
  RunView view = view_of(design);
  if (!options.panels.empty())
    view.panels =
        names_of(options.panels, ',', "--panels", std::nullopt, "names such as x1,e,claims");
  for (const std::string& text : options.planes) {
    const auto pair = names_of(text, ',', "--phase", 2, "two names, such as x1,x2");
    view.planes.emplace_back(pair[0], pair[1]);
  }
  if (!options.bands.empty()) view.covariances.clear();
  for (const std::string& text : options.bands) {
    const auto pair =
        names_of(text, ':', "--band", 2, "an estimate and its covariance, such as xh:P");
    view.covariances.push_back({pair[0], pair[1]});
  }
  return view;
}

std::vector<std::uint64_t> runs_of(const PictureOptions& options, bool compared,
                                   std::uint64_t otherwise) {
  if (options.runs.empty()) return {otherwise};
  std::vector<std::uint64_t> chosen;
  for (const std::string& part : parts_of(options.runs, ','))
    add_runs(part, options.runs, compared, chosen);
  require_different(chosen);
  return chosen;
}

}  // namespace gainsmith::app
