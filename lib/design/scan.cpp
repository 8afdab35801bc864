#include "design/scan.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "design/results.h"
#include "design/synthesize.h"

namespace gainsmith::design {

namespace {

/// The answer at a point. Stopped (base/stop.h) before it is decided.
ScanRow answer(const model::DesignPtr& design, const std::vector<std::string>& names,
               const std::vector<double>& at, const sdp::Options& solver) {
  ScanRow row;
  row.at = at;
  model::Overrides overrides;
  for (std::size_t k = 0; k < names.size(); ++k) overrides[names[k]] = at[k];
  std::optional<model::Instance> instance;
  model::Gains gains;
  try {
    instance = bind::evaluate(design, overrides);
    gains = synthesize(*instance, solver, Depth::verdict);
    // An undecided point of a stopped scan has no answer yet.
    if (gains.verdict == model::Verdict::undecided) check_stop();
  } catch (const InputError& error) {
    row.refused = error.what();
    row.interrupted = false;
    return row;
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
  return row;
}

}  // namespace

std::vector<ScanRow> rows_of(const std::vector<std::vector<double>>& points) {
  std::vector<ScanRow> rows(points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].at = points[i];
  return rows;
}

void scan(const model::DesignPtr& design, const std::vector<std::string>& names,
          const std::vector<std::size_t>& which, unsigned threads, const sdp::Options& solver,
          std::vector<ScanRow>& rows, const std::function<void()>& answered) {
  for (const std::string& name : names) model::check_scalar_name(*design, name, {design->file});
  const Doing doing("points", which.size());
  std::mutex mutex;
  try {
    parallel_for(which.size(), threads, [&](std::size_t k) {
      ScanRow row = answer(design, names, rows[which[k]].at, solver);
      const std::scoped_lock lock(mutex);
      rows[which[k]] = std::move(row);
      doing.step();
      if (answered) answered();
    });
  } catch (const Stopped&) {
    // The rows that it did not reach say so.
  }
}

void require_a_point(const std::vector<ScanRow>& rows) {
  const bool any =
      std::any_of(rows.begin(), rows.end(), [](const ScanRow& row) { return row.refused.empty(); });
  if (!any && !rows.empty()) throw InputError({}, rows.front().refused);
}

std::vector<ScanRow> scan(const model::DesignPtr& design, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& points, unsigned threads,
                          const sdp::Options& solver) {
  std::vector<ScanRow> rows = rows_of(points);
  std::vector<std::size_t> all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  scan(design, names, all, threads, solver, rows);
  require_a_point(rows);
  return rows;
}

}  // namespace gainsmith::design
