#include "statistics/bound_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/unit_roundoff.h"
#include "base/whole_number.h"
#include "claims/independence.h"

namespace gainsmith::statistics {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Whether its number is that of jumps of the event.
bool is_of_event(model::FigureKind kind) {
  using Kind = model::FigureKind;
  return kind == Kind::at_event || kind == Kind::nis || model::is_whole(kind);
}

/// The elements of the variables by which the event happens.
std::vector<Eigen::Index> guarding(std::size_t event, const hybrid::System& system) {
  std::vector<Eigen::Index> elements;
  const std::vector<bool> read = claims::read_by_guards(system.dynamics, event);
  for (std::size_t k = 0; k < read.size(); ++k)
    for (Eigen::Index e = 0; read[k] && e < system.layout.slots[k].shape.size(); ++e)
      elements.push_back(system.layout.slots[k].offset + e);
  return elements;
}

}  // namespace

BoundFigure::BoundFigure(const model::Figure& figure, const claims::RunSetup& setup)
    : setup_(&setup) {
  std::optional<claims::RunValue> value;
  if (figure.value) {
    program_ = setup.texts.stated.bodies.link(figure.value->program);
    for (const expr::Input& input : program_->inputs)
      if (!setup.system.slot(input.name) && !setup.system.constants.contains(input.name))
        throw InputError(figure.value->place, "there is no value for " + input.name);
    value.emplace(*program_, setup.layout, setup.system.constants);
  }
  std::vector<double> constants;
  for (const model::Formula& number : figure.numbers)
    constants.push_back(setup.system.scalar(number));
  std::optional<Eigen::Index> passes;
  if (figure.kind == model::FigureKind::passes) {
    const std::string& event = setup.system.dynamics.events[figure.event].name;
    if (const auto slot = setup.system.slot(expr::event_number("passes", event)))
      passes = setup.system.layout.slots[*slot].offset;
  }
  number_.emplace(figure.kind, std::move(value), std::move(constants), figure.event, figure.count,
                  figure.after, passes);
  if (is_of_event(figure.kind)) elements_ = guarding(figure.event, setup.system);
  is_whole_ = model::is_whole(figure.kind);
  is_at_guard_ =
      figure.kind == model::FigureKind::at_event && !setup.system.has_clock(figure.event);
  if (passes) elements_.push_back(*passes);
  if (!program_) return;
  claims::RunValue& reads = *number_->value();
  rests_ = figure.kind != model::FigureKind::integral && figure.kind != model::FigureKind::rms &&
           std::ranges::all_of(reads.used(), [&](Eigen::Index e) { return setup.system.rests(e); });
  elements_.insert(elements_.end(), reads.used().begin(), reads.used().end());
  ball_.emplace(*program_, reads, setup.layout, setup.constants);
}

Estimate BoundFigure::of(const claims::TwinRun& runs) {
  const std::optional<double> other = of(runs.twin);
  const Eigen::VectorXd twin = number_->moment();
  Estimate result{of(runs.run), 0, {}};
  result.why = runs.unknown(number_->until(), elements_, setup_->system);
  if (result.why.empty() && other.has_value() != result.value.has_value())
    result.why = "whether there is such a number hangs on the accuracy";
  if (result.why.empty() && is_whole_ && other != result.value)
    result.why = "how many there are hangs on the accuracy";
  if (result.why.empty() && result.value) {
    const double value = *result.value;
    const double difference = *other == value ? 0 : std::abs(*other - value);
    const double own = number_->own_error(runs.run) + rounding(value, twin);
    result.error = own + claims::error_factor(setup_->system) * difference;
    if (result.error == 0 && (is_exact_whole(value) || std::isinf(value))) return result;
    // Of what moves both runs may be equal by chance.
    const bool is_still = difference == 0 && rests_;
    const double roundings = 8 + (is_still ? 0 : runs.steps());
    const double relative = roundings * kUnitRoundoff + (is_still ? 0 : runs.accuracy);
    result.error += relative * std::abs(value);
    if (!result.known()) result.why = "it changes without bounds within the errors of the run";
  }
  if (!result.why.empty()) result.error = kUnknown;
  return result;
}

/// What the text of the figure makes of errors that the difference of two values does not show.
double BoundFigure::rounding(double value, const Eigen::VectorXd& twin) {
  const Eigen::VectorXd& x = number_->moment();
  if (!ball_ || x.size() == 0 || x.size() != twin.size()) return 0;
  const Eigen::VectorXd all = claims::errors_of(x, twin, claims::error_factor(setup_->system));
  Eigen::VectorXd error = Eigen::VectorXd::Zero(x.size());
  for (const Eigen::Index e : number_->value()->used()) error(e) = all(e);
  if (is_at_guard_ || error.isZero(0) || !ball_->is_open(x, error)) return ball_->rounding(x);
  const claims::Bounded hull = ball_->hull(x, error);
  return hull.bound + std::abs(hull.value - value);
}

}  // namespace gainsmith::statistics
