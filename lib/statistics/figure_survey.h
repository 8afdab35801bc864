// Figures over the runs of a campaign: what each of them is in all, in bounded memory.
//
// Each run is made by the careful simulator, to the accuracy of expected figures, beside a second
// run (claims/twin_runs.h). A number that this pair does not know counts as such. The survey of
// some runs is the sum of the surveys of its parts, in any order and grouping to the same bits: of
// blocks on threads as of campaigns on several machines.
//
// The room: figure_survey and bound_figure (figures with errors), value_sketch and quantiles (order
// statistics), exact_sum and consistency (NEES and NIS), sample_bounds (probability of a
// violation), run_set and run_blocks (which runs, and sums over them).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "claims/run_setup.h"
#include "model/figure.h"
#include "statistics/consistency.h"
#include "statistics/run_set.h"
#include "statistics/value_sketch.h"

namespace gainsmith::statistics {

/// The value of a run.
struct OfRun {
  double value = 0;
  std::uint64_t run = 0;
  double error = 0;

  bool operator==(const OfRun&) const = default;
};

/// Runs to which something happened.
struct SomeRuns {
  std::uint64_t count = 0;
  std::uint64_t first = 0;  ///< the first of them ...
  std::string why;          ///< ... and why

  bool operator==(const SomeRuns&) const = default;
};

/// A figure over some runs.
struct FigureSummary {
  std::string title;
  std::string observer;        ///< empty: of none
  ValueSketch values{};        ///< of the runs that have such a number; it may be infinite
  double error = 0;            ///< the largest of these values
  std::uint64_t without = 0;   ///< runs that have none
  SomeRuns unknown{};          ///< runs of which it is not known
  std::optional<OfRun> least;  ///< of several runs the first
  std::optional<OfRun> largest;
  SquaredErrors squares{};  ///< of `nees` and `nis`; the values are the means of each run
  bool whole = false;       ///< all values are whole numbers, or infinite

  void add(const FigureSummary& more);
  bool operator==(const FigureSummary&) const = default;
};

struct FigureSurvey {
  std::uint64_t runs = 0;
  std::vector<FigureSummary> figures;
  SomeRuns early{};  ///< that ended before their horizon, and not by zeno

  void add(const FigureSurvey& more);
  bool operator==(const FigureSurvey&) const = default;
};

/// Numbers of runs: those that are listed, or so many from the first on.
struct RunNumbers {
  std::uint64_t count = 0;
  std::vector<std::uint64_t> listed{};
  std::uint64_t first = 0;

  std::uint64_t operator[](std::uint64_t k) const {
    return listed.empty() ? first + k : listed[static_cast<std::size_t>(k)];
  }
};

/// The survey of figures over these runs of a seed. A stop (base/stop.h) leaves out those behind
/// the first that was not made. InputError where a name of a figure has no value.
FigureSurvey survey_figures(const claims::RunSetup& setup,
                            const std::vector<model::Figure>& figures, std::uint64_t seed,
                            const RunNumbers& runs, unsigned threads = 0);

/// The figures over some runs of a campaign, which grow with it.
struct SurveyOfRuns {
  RunSet runs;
  FigureSurvey survey;  ///< without figures where there are no runs

  /// Adds those of other runs.
  void add(const SurveyOfRuns& more);
  bool operator==(const SurveyOfRuns&) const = default;
};

/// Adds those of these runs that it has not. `grown` is called now and then, when it has more. A stop
/// (base/stop.h) ends it before.
void grow(const claims::RunSetup& setup, const std::vector<model::Figure>& figures,
          std::uint64_t seed, RunRange range, unsigned threads, SurveyOfRuns& sum,
          const std::function<void()>& grown = {});

}  // namespace gainsmith::statistics
