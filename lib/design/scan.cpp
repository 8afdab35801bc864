#include "design/scan.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "design/results.h"
#include "design/synthesize.h"

namespace gainsmith::design {

std::vector<ScanRow> scan(const model::DesignPtr& design, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& points, unsigned threads,
                          const sdp::Options& solver) {
  for (const std::string& name : names) model::check_scalar_name(*design, name, {design->file});
  std::vector<ScanRow> rows(points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].at = points[i];
  const auto solve = [&](std::size_t i) {
    Doing::step();
    ScanRow& row = rows[i];
    model::Overrides overrides;
    for (std::size_t k = 0; k < names.size(); ++k) overrides[names[k]] = points[i][k];
    std::optional<model::Instance> instance;
    model::Gains gains;
    try {
      instance = bind::evaluate(design, overrides);
      gains = synthesize(*instance, solver, Depth::verdict);
      if (gains.verdict == model::Verdict::undecided) check_stop();
    } catch (const InputError& error) {
      row.refused = error.what();
      row.interrupted = false;
      return;
    }
    const Concluding concluding;
    row.verdict = gains.verdict;
    if (gains.verdict == model::Verdict::yes) row.objective = gains.objective;
    const Results results(*instance, gains);
    for (const model::NamedFormula& figure : instance->design->figures) {
      const auto value = results.value(figure.value);
      row.figures.push_back(value ? std::optional((*value)(0, 0)) : std::nullopt);
    }
    row.interrupted = false;
  };
  const Doing doing("points", points.size());
  try {
    parallel_for(points.size(), threads, solve);
  } catch (const Stopped&) {
    // The rows that it reached say so.
  }
  const bool any =
      std::any_of(rows.begin(), rows.end(), [](const ScanRow& row) { return row.refused.empty(); });
  if (!any && !rows.empty()) throw InputError({}, rows.front().refused);
  return rows;
}

}  // namespace gainsmith::design
