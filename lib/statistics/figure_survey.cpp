#include "statistics/figure_survey.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "base/progress.h"
#include "statistics/bound_figure.h"
#include "statistics/run_blocks.h"

namespace gainsmith::statistics {

namespace {

void keep_least(const std::optional<OfRun>& more, std::optional<OfRun>& least) {
  if (more && (!least || std::pair(more->value, more->run) < std::pair(least->value, least->run)))
    least = more;
}

void keep_largest(const std::optional<OfRun>& more, std::optional<OfRun>& largest) {
  if (more &&
      (!largest || std::pair(-more->value, more->run) < std::pair(-largest->value, largest->run)))
    largest = more;
}

FigureSurvey empty_survey(const std::vector<model::Figure>& figures) {
  FigureSurvey survey;
  for (const model::Figure& figure : figures) {
    FigureSummary& summary = survey.figures.emplace_back();
    summary.title = figure.title;
    summary.observer = figure.observer;
    summary.squares.elements = figure.elements;
    summary.whole = model::is_whole(figure.kind);
  }
  return survey;
}

void count(const SomeRuns& more, SomeRuns& some) {
  if (more.count > 0 && (some.count == 0 || more.first < some.first)) {
    some.first = more.first;
    some.why = more.why;
  }
  some.count += more.count;
}

/// Figures of run after run; one for each thread.
class Surveyor {
 public:
  Surveyor(const claims::RunSetup& setup, const std::vector<model::Figure>& figures,
           std::uint64_t seed)
      : seed_(seed), runs_(setup), survey_(empty_survey(figures)), values_(figures.size()) {
    for (const model::Figure& figure : figures)
      figures_.push_back(std::make_unique<BoundFigure>(figure, setup));
  }

  /// Figures check for a stop too (balls factorise a covariance): a run is added whole, or not.
  void add(std::uint64_t run) {
    const claims::TwinRun made = runs_(seed_, run, claims::kAccuracyOfOne);
    std::vector<Estimate> estimates;
    estimates.reserve(figures_.size());
    for (const std::unique_ptr<BoundFigure>& figure : figures_)
      estimates.push_back(figure->of(made));
    ++survey_.runs;
    if (const hybrid::Trajectory& trajectory = made.run; !is_complete(trajectory.ending))
      count({1, run,
             to_string(trajectory.ending) +
                 (trajectory.message.empty() ? "" : ": " + trajectory.message)},
            survey_.early);
    for (std::size_t k = 0; k < estimates.size(); ++k) add(k, run, estimates[k]);
  }

  FigureSurvey result() {
    for (std::size_t k = 0; k < values_.size(); ++k) survey_.figures[k].values.add(values_[k]);
    return std::move(survey_);
  }

 private:
  void add(std::size_t k, std::uint64_t run, const Estimate& estimate) {
    FigureSummary& summary = survey_.figures[k];
    if (!estimate.known()) {
      count({1, run, estimate.why}, summary.unknown);
      return;
    }
    if (summary.squares.elements > 0) summary.squares.add(figures_[k]->squares());
    if (!estimate.value) {
      ++summary.without;
      return;
    }
    values_[k].push_back(*estimate.value);
    summary.error = std::max(summary.error, estimate.error);
    keep_least(OfRun{*estimate.value, run, estimate.error}, summary.least);
    keep_largest(OfRun{*estimate.value, run, estimate.error}, summary.largest);
  }

  std::uint64_t seed_;
  claims::TwinRuns runs_;
  std::vector<std::unique_ptr<BoundFigure>> figures_;
  FigureSurvey survey_;
  std::vector<std::vector<double>> values_;  ///< by figure
};

}  // namespace

void FigureSummary::add(const FigureSummary& more) {
  values.add(more.values);
  error = std::max(error, more.error);
  without += more.without;
  count(more.unknown, unknown);
  keep_least(more.least, least);
  keep_largest(more.largest, largest);
  squares.add(more.squares);
}

void FigureSurvey::add(const FigureSurvey& more) {
  runs += more.runs;
  count(more.early, early);
  for (std::size_t k = 0; k < figures.size(); ++k) figures[k].add(more.figures[k]);
}

FigureSurvey survey_figures(const claims::RunSetup& setup,
                            const std::vector<model::Figure>& figures, std::uint64_t seed,
                            const RunNumbers& runs, unsigned threads) {
  FigureSurvey all = empty_survey(figures);
  const Doing doing("figures", runs.count);
  sum_over_runs(
      runs.count, threads, [&] { return Surveyor(setup, figures, seed); },
      [&](Surveyor& surveyor, std::uint64_t k) {
        surveyor.add(runs[k]);
        doing.step();
      },
      [&](Surveyor& surveyor) { all.add(surveyor.result()); });
  return all;
}

void SurveyOfRuns::add(const SurveyOfRuns& more) {
  if (more.runs.count() == 0) return;
  if (runs.count() == 0) {
    *this = more;
    return;
  }
  for (const RunRange& range : more.runs.ranges()) runs.add(range);
  survey.add(more.survey);
}

void grow(const claims::RunSetup& setup, const std::vector<model::Figure>& figures,
          std::uint64_t seed, RunRange range, unsigned threads, SurveyOfRuns& sum,
          const std::function<void()>& grown) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kStep(1);
  std::uint64_t size = std::uint64_t{64} * thread_count(threads);
  const std::vector<RunRange> missing = sum.runs.missing_in(range);
  std::uint64_t count = 0;
  for (const RunRange& stretch : missing) count += stretch.count();
  const std::uint64_t all = range.count();
  const Doing doing("figures", all, all - count);
  for (const RunRange& stretch : missing)
    for (std::uint64_t first = stretch.first; first < stretch.last;) {
      const auto begin = Clock::now();
      const std::uint64_t asked = std::min(size, stretch.last - first);
      SurveyOfRuns more;
      more.survey = survey_figures(setup, figures, seed, {asked, {}, first}, threads);
      more.runs.add({first, first + more.survey.runs});
      sum.add(more);
      doing.step(more.survey.runs);
      if (grown) grown();
      if (more.survey.runs < asked) return;
      first += asked;
      if (Clock::now() - begin < kStep) size *= 2;
    }
}

}  // namespace gainsmith::statistics
