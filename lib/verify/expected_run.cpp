#include "verify/expected_run.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/known_digits.h"
#include "base/number.h"
#include "base/unit_roundoff.h"
#include "bind/stated.h"
#include "claims/run_setup.h"
#include "statistics/bound_figure.h"

namespace gainsmith::verify {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The number with the digits that its error leaves, or why there is none.
std::string said(const statistics::Estimate& found, double end) {
  if (!found.known()) return "a number that is not known: " + found.why;
  return found.value ? brief(*found.value, 9, found.error)
                     : "none until the run ends, at t = " + brief(end, 9);
}

}  // namespace

RunDifferences run_differences(const model::Instance& instance, const model::Gains& gains) {
  RunDifferences result;
  const auto& expect = instance.design->expect;
  if (!expect || expect->run.empty()) return result;
  const auto setup = claims::make_run_setup(bind::run_texts(instance, gains));
  const std::uint64_t seed = instance.design->campaign.seed;
  claims::TwinRuns twins(*setup);
  const claims::TwinRun runs = twins(seed, 0, claims::kAccuracyOfOne);
  std::optional<claims::TwinRun> in_31_digits;  // made where a figure is not known
  for (const model::ExpectedFigure& expected : expect->run) {
    ++result.figures;
    const model::Figure& figure = expected.figure;
    const std::string who = figure.observer.empty() ? "" : figure.observer + ": ";
    const std::string what = to_string(figure.place) + ": " + who + figure.title + ": expected ";
    if (figure.kind == model::FigureKind::ended) {
      const std::string& message = runs.run.message;
      const std::string text = what + expected.ending + ", found " + to_string(runs.run.ending) +
                               (message.empty() ? "" : " (" + message + ")");
      const bool is_so = to_string(runs.run.ending) == expected.ending;
      if (runs.run.ending != runs.twin.ending)
        result.undecided.push_back(text + ": " + runs.doubt);
      else if (!is_so)
        result.different.push_back(text);
      continue;
    }
    statistics::BoundFigure bound(figure, *setup);
    statistics::Estimate found = bound.of(runs);
    if (!found.known() && setup->has_31_digits()) {
      if (!in_31_digits) in_31_digits = twins.in_31_digits(seed, 0, claims::kAccuracyOfOne);
      statistics::Estimate sharper = bound.of(*in_31_digits);
      // One that ends before its time says what has been by then, and nothing of the whole.
      const bool has_been = figure.kind == model::FigureKind::at_time && sharper.value;
      if (sharper.known() && (has_been || is_complete(in_31_digits->run.ending)))
        found = std::move(sharper);
    }
    const auto limit = [&](const model::Formula& formula) {
      return numbers::evaluate(formula.program, instance.values)(0, 0);
    };
    // By how much the number is beyond what is expected. Decimals are rounded: what is equal to
    // them but for that is as expected.
    const auto judge = [&](std::string text, double over, double is) {
      text += ", found " + said(found, runs.run.end);
      if (found.known() && !(over <= found.error))
        result.different.push_back(text);
      else if (!(over + found.error <= 16 * kUnitRoundoff * std::abs(is)))
        result.undecided.push_back(found.known() ? text + ": its error does not decide" : text);
    };
    const auto within = [&](const model::Formula& formula, const char* words, double sign) {
      const double most = limit(formula);
      judge(what + words + brief(most, 9), sign * (found.value.value_or(kNone) - most), most);
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
    judge(what + fmt::format("{} within {}", brief(wanted, 9), brief(allowed)),
          std::abs(found.value.value_or(kNone) - wanted) - allowed, wanted);
  }
  return result;
}

}  // namespace gainsmith::verify
