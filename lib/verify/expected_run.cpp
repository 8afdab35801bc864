#include "verify/expected_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/number.h"
#include "base/stop.h"
#include "bind/stated.h"
#include "claims/run_setup.h"
#include "statistics/bound_figure.h"

namespace gainsmith::verify {

namespace {

struct FoundFigure {
  std::optional<double> value;  ///< none: the run has no such number
  /// How far it is from that of a run integrated to a hundredth of the tolerance.
  double difference = 0;
};

/// The first run to two accuracies, and figures of both.
class TwoRuns {
 public:
  /// The setup must outlive it.
  TwoRuns(const claims::RunSetup& setup, std::uint64_t seed,
          std::optional<hybrid::Trajectory> usual)
      : setup_(&setup) {
    simulate::Simulator simulator(setup_->system, setup_->scenario);
    usual_ = usual ? std::move(*usual)
                   : simulator.run(seed, 0, setup_->accuracy(claims::kAccuracyOfOne));
    sharper_ = simulator.run(seed, 0, setup_->accuracy(claims::kAccuracyOfOne, claims::kSharper));
    check_stop();
  }

  hybrid::Ending ending() const { return sharper_.ending; }
  const std::string& message() const { return sharper_.message; }
  double end() const { return sharper_.end; }

  /// What is not known of a figure, however well the runs agree: numbers of events are whole.
  double accuracy_of(const model::Figure& figure, std::optional<double> value) const {
    using Kind = model::FigureKind;
    if (figure.kind == Kind::count || figure.kind == Kind::passes || figure.kind == Kind::lost)
      return 0;
    if (!value || !std::isfinite(*value)) return 0;
    const simulate::Accuracy accuracy = setup_->accuracy(claims::kAccuracyOfOne);
    return accuracy.relative * std::abs(*value) + accuracy.absolute;
  }

  FoundFigure find(const model::Figure& figure) {
    FoundFigure found;
    const auto [usual, sharper] = numbers(figure);
    found.value = sharper;
    if (usual && sharper) found.difference = *usual == *sharper ? 0 : std::abs(*usual - *sharper);
    if (usual.has_value() != sharper.has_value())
      found.difference = std::numeric_limits<double>::infinity();
    return found;
  }

 private:
  std::pair<std::optional<double>, std::optional<double>> numbers(const model::Figure& figure) {
    statistics::BoundFigure bound(figure, *setup_);
    const auto usual = bound.of(usual_);
    return {usual, bound.of(sharper_)};
  }

  const claims::RunSetup* setup_;
  hybrid::Trajectory usual_;
  hybrid::Trajectory sharper_;
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string said(const std::optional<double>& value, double end) {
  return value ? brief(*value, 9) : "none until the run ends, at t = " + brief(end, 9);
}

}  // namespace

RunDifferences run_differences(const model::Instance& instance, const model::Gains& gains,
                               std::optional<hybrid::Trajectory> made) {
  RunDifferences result;
  const auto& expect = instance.design->expect;
  if (!expect || expect->run.empty()) return result;
  const auto setup = claims::make_run_setup(bind::run_texts(instance, gains));
  TwoRuns runs(*setup, instance.design->campaign.seed, std::move(made));
  for (const model::ExpectedFigure& expected : expect->run) {
    ++result.figures;
    const model::Figure& figure = expected.figure;
    const std::string who = figure.observer.empty() ? "" : figure.observer + ": ";
    const std::string what = to_string(figure.place) + ": " + who + figure.title + ": expected ";
    if (figure.kind == model::FigureKind::ended) {
      if (to_string(runs.ending()) != expected.ending)
        result.different.push_back(what + expected.ending + ", found " + to_string(runs.ending()) +
                                   (runs.message().empty() ? "" : " (" + runs.message() + ")"));
      continue;
    }
    const FoundFigure found = runs.find(figure);
    const auto limit = [&](const model::Formula& formula) {
      return numbers::evaluate(formula.program, instance.values)(0, 0);
    };
    const auto within = [&](const model::Formula& formula, const char* words, double sign) {
      const double most = limit(formula);
      const std::string text =
          what + words + brief(most, 9) + ", found " + said(found.value, runs.end());
      const double over = found.value ? sign * (*found.value - most) : kNone;
      const double known = std::max(found.difference, runs.accuracy_of(figure, found.value));
      if (!(over <= known))
        result.different.push_back(text);
      else if (over > 0 || !(over + found.difference <= 0))
        result.undecided.push_back(text + " +- " + brief(known));
    };
    if (expected.below && expected.above && limit(*expected.above) > limit(*expected.below))
      throw InputError(figure.place, "is: no number is above " + brief(limit(*expected.above), 9) +
                                         " and below " + brief(limit(*expected.below), 9));
    if (expected.below) within(*expected.below, "at most ", 1);
    if (expected.above) within(*expected.above, "at least ", -1);
    if (!expected.is) continue;
    const double wanted = numbers::evaluate(expected.is->program, instance.values)(0, 0);
    const double allowed =
        std::max(expected.absolute.value_or(0), expected.relative.value_or(0) * std::abs(wanted));
    const std::string text = what + fmt::format("{} within {}, found {}", brief(wanted, 9),
                                                brief(allowed), said(found.value, runs.end()));
    if (!found.value || !(std::abs(*found.value - wanted) <= allowed))
      result.different.push_back(text);
    else if (!(found.difference <= allowed))
      result.undecided.push_back(text + " +- " + brief(found.difference));
  }
  return result;
}

}  // namespace gainsmith::verify
