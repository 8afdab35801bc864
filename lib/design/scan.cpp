#include "design/scan.h"

#include <algorithm>
#include <optional>

#include "base/parallel.h"
#include "design/results.h"
#include "design/synthesize.h"

namespace gainsmith::design {

namespace {

std::optional<double> scalar(const Results& results, const expr::Expression& figure) {
  const auto value = results.value(figure);
  if (!value) return std::nullopt;
  if (value->size() != 1)
    throw InputError(figure.place(*figure.root),
                     "expected a number, found a matrix: " + figure.text->str());
  return (*value)(0, 0);
}

}  // namespace

std::vector<ScanRow> scan(const model::Problem& problem, const std::vector<std::string>& names,
                          const std::vector<std::vector<double>>& points,
                          const std::vector<expr::Expression>& figures, unsigned threads,
                          const sdp::Options& solver) {
  for (const std::string& name : names)
    model::check_scalar_name(*problem.method, name, {problem.file});
  std::vector<ScanRow> rows(points.size());
  parallel_for(points.size(), threads, [&](std::size_t i) {
    ScanRow& row = rows[i];
    row.at = points[i];
    const auto interrupted = [&] { return solver.interrupted && solver.interrupted(); };
    row.interrupted = interrupted();
    if (row.interrupted) return;
    model::Overrides overrides;
    for (std::size_t k = 0; k < names.size(); ++k) overrides[names[k]] = points[i][k];
    std::optional<model::Instance> instance;
    model::Gains gains;
    try {
      instance = model::make_instance(problem, overrides);
      gains = synthesize(*instance, solver);
    } catch (const InputError& error) {
      row.refused = error.what();
      return;
    }
    row.verdict = gains.verdict;
    row.interrupted = gains.verdict == model::Verdict::undecided && interrupted();
    if (gains.verdict == model::Verdict::yes) row.objective = gains.objective;
    const Results results(*instance, gains);
    for (const expr::Expression& figure : figures) row.figures.push_back(scalar(results, figure));
  });
  const bool any =
      std::any_of(rows.begin(), rows.end(), [](const ScanRow& row) { return row.refused.empty(); });
  if (!any && !rows.empty()) throw InputError({}, rows.front().refused);
  return rows;
}

}  // namespace gainsmith::design
