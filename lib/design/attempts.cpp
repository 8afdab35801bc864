#include "design/attempts.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "base/progress.h"
#include "base/stop.h"
#include "design/facial_reduction.h"
#include "design/gain_values.h"

namespace gainsmith::design {

/// When each kind is due, and what it asks.
struct AttemptRules {
  static constexpr double kTighter = 0.1;  ///< times the bound on gains
  static constexpr double kNear = 0.01;  ///< of the bound; a gain far below it is not limited by it

  static bool has_minimum(const Attempts& attempts) {
    return lmi::has_minimum(attempts.posed_.lmi, attempts.bounds_);
  }
  /// Neither a yes within the bounds nor a refutation.
  static bool nothing_holds(const Attempts& attempts) {
    const Attempt* point = attempts.point();
    return (point == nullptr || !attempts.is_yes(*point)) && attempts.refutation() == nullptr;
  }
  /// Not even with gains beyond the bound.
  static bool nothing_holds_at_all(const Attempts& attempts) {
    const Attempt* point = attempts.point();
    return (point == nullptr || !point->holds()) && attempts.refutation() == nullptr;
  }
  static bool is_bounded(const Attempts& attempts) { return !attempts.bounds_.list.empty(); }

  /// Without an objective it comes first; after one only where the bounds leave nothing.
  static bool free_inside_is_due(const Attempts& attempts) {
    return is_bounded(attempts) && !has_minimum(attempts);
  }
  static bool bounds_leave_nothing(const Attempts& attempts) {
    return is_bounded(attempts) && attempts.find(AttemptKind::free_inside) == nullptr &&
           nothing_holds_at_all(attempts);
  }
  /// Beside equations nothing has room to spare: only the face that they leave has.
  static bool has_room(const Attempts& attempts) { return !states_equations(attempts.posed_.lmi); }
  static bool minimum_is_due(const Attempts& attempts) {
    return has_minimum(attempts) && has_room(attempts);
  }
  /// The last attempt at the minimum within the bounds.
  static const Attempt* last_minimum(const Attempts& attempts) {
    const Attempt* large = attempts.find(AttemptKind::large_minimum);
    return large != nullptr ? large : attempts.find(AttemptKind::minimum);
  }
  /// The minimum is found but its point does not hold, and a point inside does.
  static bool blended_is_due(const Attempts& attempts) {
    const Attempt* minimum = last_minimum(attempts);
    const Attempt* inside = attempts.find(AttemptKind::inside);
    return minimum != nullptr && minimum->is_near_optimal() && !minimum->holds() &&
           inside != nullptr && inside->holds();
  }
  /// That no x of ordinary size has the margin says nothing where a point holds.
  static bool large_minimum_is_due(const Attempts& attempts) {
    const Attempt* minimum = attempts.find(AttemptKind::minimum);
    const Attempt* inside = attempts.find(AttemptKind::inside);
    return minimum != nullptr && inside != nullptr && inside->holds() &&
           minimum->solution.status == sdp::Status::primal_infeasible &&
           std::isfinite(minimum->solution.certificate.excluded_radius);
  }
  static bool free_minimum_is_due(const Attempts& attempts) {
    return is_bounded(attempts) && minimum_is_due(attempts) && nothing_holds(attempts);
  }
  /// More digits are of use only where the blocks come from the decimals of the file.
  static bool digits_are_due(const Attempts& attempts) {
    return attempts.posed_.wide && attempts.posed_.lmi.represents_points() &&
           nothing_holds_at_all(attempts);
  }
  /// Nothing holds, or a certificate excludes that is not exact.
  static bool faces_are_due(const Attempts& attempts) {
    const Attempt* refuted = attempts.refutation();
    const bool inexact = refuted != nullptr && !refuted->refutation->exact &&
                         attempts.posed_.wide && attempts.posed_.check.describe;
    return attempts.posed_.lmi.represents_points() && (nothing_holds_at_all(attempts) || inexact) &&
           attempts.find(AttemptKind::on_equations) == nullptr;
  }
  static bool equations_are_due(const Attempts& attempts) {
    return attempts.posed_.lmi.represents_points() && !has_room(attempts);
  }
  /// A yes at a minimum, with a gain that is large without being at its bound.
  static bool tighter_is_due(const Attempts& attempts) {
    const Attempt* point = attempts.point();
    if (!attempts.posed_.check.describe || point == nullptr || !attempts.is_yes(*point) ||
        !has_minimum(attempts) || attempts.is_free(*point))
      return false;
    const auto bounds = lmi::reached_bounds(attempts.bounds_, point->x);
    return std::any_of(bounds.begin(), bounds.end(), [](const model::GainBound& bound) {
      return !bound.active && bound.reached > kNear * bound.bound;
    });
  }

  static Attempt ask(const Attempts& attempts, Question question) {
    return measured(attempts, attempt(attempts.posed_, std::move(question), attempts.solve_));
  }
  /// With its largest gain, where no bound was asked for.
  static Attempt measured(const Attempts& attempts, Attempt result) {
    if (result.point && attempts.is_free(result)) {
      const lmi::Inequalities& of = attempts.posed_.inequalities;
      numbers::Values values = of.instance.values;
      for (auto& [name, matrix] : of.unknowns.values(result.x)) values[name] = matrix;
      result.largest_gain = largest_gain(of, values);
      result.reached_gain = result.largest_gain;
      // In the units of the bound.
      if (!attempts.bounds_.units.empty() && !attempts.bounds_.list.empty()) {
        result.reached_gain = 0;
        for (const auto& bound : lmi::reached_bounds(attempts.bounds_, result.x))
          result.reached_gain =
              std::max(result.reached_gain, bound.reached / bound.bound * attempts.bounds_.beta);
      }
    }
    return result;
  }
  /// Relative gap 1e-8, with the margin that the problem asks for.
  static Question objective(const Attempts& attempts, lmi::GainBounds bounds) {
    return {
        lmi::Goal::objective, std::move(bounds), {"auto", 1e-8}, attempts.posed_.choices().margin};
  }
  static Question interior(lmi::GainBounds bounds, Effort effort = {}) {
    return {lmi::Goal::interior, std::move(bounds), std::move(effort), 0};
  }

  static std::optional<Attempt> minimum(const Attempts& attempts) {
    return ask(attempts, objective(attempts, attempts.bounds_));
  }
  static std::optional<Attempt> inside(const Attempts& attempts) {
    return attempts.inside_ ? *attempts.inside_ : ask(attempts, interior(attempts.bounds_));
  }
  /// Not ended by a certificate against x below some 1e16.
  static std::optional<Attempt> large_minimum(const Attempts& attempts) {
    Question question = objective(attempts, attempts.bounds_);
    question.effort.certificate_tolerance = 1e-16;
    return ask(attempts, std::move(question));
  }
  static std::optional<Attempt> blended(const Attempts& attempts) {
    return design::blended(attempts.posed_, *last_minimum(attempts),
                           *attempts.find(AttemptKind::inside), attempts.solve_);
  }
  static std::optional<Attempt> free_minimum(const Attempts& attempts) {
    return ask(attempts, objective(attempts, {}));
  }
  static std::optional<Attempt> free_inside(const Attempts& attempts) {
    return ask(attempts, interior({}));
  }
  static std::optional<Attempt> in_31_digits(const Attempts& attempts) {
    return ask(attempts, interior({}, {"quad", 1e-22}));
  }
  /// Without bounds on gains; where its gains are too large, once more with them.
  static std::optional<Attempt> facial_reduction(const Attempts& attempts) {
    auto found = measured(attempts, attempt_facial_reduction(attempts.posed_, {}, attempts.solve_));
    if (!found || !found->holds() || attempts.is_yes(*found)) return found;
    auto within = attempt_facial_reduction(attempts.posed_, attempts.bounds_, attempts.solve_);
    return within && within->holds() ? std::move(within) : std::move(found);
  }
  static std::optional<Attempt> measured(const Attempts& attempts, std::optional<Attempt> found) {
    if (found) found = measured(attempts, std::move(*found));
    return found;
  }
  static std::optional<Attempt> tighter(const Attempts& attempts) {
    return ask(attempts, objective(attempts, lmi::gain_bounds(attempts.posed_.inequalities,
                                                              kTighter * attempts.bounds_.beta,
                                                              attempts.bounds_.units)));
  }
};

namespace {

/// One line of the table in attempts.h: its condition, its question and its name for progress.
struct Row {
  AttemptKind kind;
  bool (*is_due)(const Attempts&);
  std::optional<Attempt> (*tries)(const Attempts&);
  const char* doing;
};

constexpr std::array<Row, 11> kAttempts = {{
    {AttemptKind::on_equations, AttemptRules::equations_are_due, AttemptRules::facial_reduction,
     "a face that the equations leave"},
    {AttemptKind::minimum, AttemptRules::minimum_is_due, AttemptRules::minimum, "the minimum"},
    {AttemptKind::free_inside, AttemptRules::free_inside_is_due, AttemptRules::free_inside,
     "the largest margin, gains of any size"},
    {AttemptKind::inside, AttemptRules::nothing_holds, AttemptRules::inside, "the largest margin"},
    {AttemptKind::large_minimum, AttemptRules::large_minimum_is_due, AttemptRules::large_minimum,
     "the minimum, unknowns of any size"},
    {AttemptKind::blended, AttemptRules::blended_is_due, AttemptRules::blended,
     "a point near the minimum"},
    {AttemptKind::free_minimum, AttemptRules::free_minimum_is_due, AttemptRules::free_minimum,
     "the minimum, gains of any size"},
    {AttemptKind::free_inside, AttemptRules::bounds_leave_nothing, AttemptRules::free_inside,
     "the largest margin, gains of any size"},
    {AttemptKind::in_31_digits, AttemptRules::digits_are_due, AttemptRules::in_31_digits,
     "the largest margin in 31 digits"},
    {AttemptKind::facial_reduction, AttemptRules::faces_are_due, AttemptRules::facial_reduction,
     "a face that all solutions share"},
    {AttemptKind::tighter, AttemptRules::tighter_is_due, AttemptRules::tighter, "smaller gains"},
}};

}  // namespace

Attempts::Attempts(const Posed& posed, lmi::GainBounds bounds, Solve solve)
    : posed_(posed), bounds_(std::move(bounds)), solve_(std::move(solve)) {}

template <class Tries>
void Attempts::make(AttemptKind kind, const char* what, const Tries& tries) {
  using Clock = std::chrono::steady_clock;
  check_stop();
  doing_ = what;
  const Doing doing(what);
  const auto start = Clock::now();
  const Allowance limit(allowance() - spent_);
  try {
    if (auto found = tries()) {
      out_of_allowance_ = found->out_of_allowance;
      tried_.emplace(kind, std::move(*found));
    }
    done_.insert(kind);
  } catch (const OutOfAllowance&) {
    out_of_allowance_ = true;
  }
  spent_ += limit.spent();
  seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

void Attempts::to_point() { make_due(false); }

void Attempts::to_end() { make_due(true); }

void Attempts::to_near_minimum(std::optional<Attempt> inside) {
  const Attempt* minimum = find(AttemptKind::minimum);
  inside_ = std::move(inside);
  if (minimum == nullptr || !minimum->point || minimum->holds()) return;
  if (!inside_) {
    make(AttemptKind::inside, "the largest margin", [&] { return AttemptRules::inside(*this); });
    const Attempt* found = find(AttemptKind::inside);
    if (found == nullptr || !found->holds()) return;
    inside_ = *found;
    tried_.erase(AttemptKind::inside);
    done_.erase(AttemptKind::inside);
  }
  make(AttemptKind::blended, "a point near the minimum",
       [&] { return near_minimum(posed_, *minimum, *inside_); });
  if (find(AttemptKind::blended) == nullptr) done_.erase(AttemptKind::blended);
}

void Attempts::make_due(bool to_end) {
  for (const Row& row : kAttempts) {
    if (!to_end && (point() != nullptr || refutation() != nullptr)) return;
    if (out_of_allowance_) return;
    if (done_.contains(row.kind) || !row.is_due(*this)) continue;
    make(row.kind, row.doing, [&] { return row.tries(*this); });
  }
}

double Attempts::allowance() const {
  // Seconds, and times the work of one solution in double.
  constexpr double kLeast = 2, kMost = 60, kTimes = 20;
  // Iterations of the interior-point method, as a rule.
  constexpr double kIterations = 20;
  if (posed_.choices().full_effort) return std::numeric_limits<double>::infinity();
  // Never less than the solver itself takes in double.
  const double solver = kIterations * posed_.lmi.multiplications() * kDoubleWork;
  return std::max(2 * solver, std::clamp(kTimes * solver, kLeast, kMost));
}

const Attempt* Attempts::find(AttemptKind kind) const {
  const auto found = tried_.find(kind);
  return found == tried_.end() ? nullptr : &found->second;
}

const Attempt* Attempts::point() const {
  // A minimum is worth more than a point inside; within the bounds more than without.
  constexpr AttemptKind kWorth[] = {
      AttemptKind::minimum,      AttemptKind::large_minimum, AttemptKind::blended,
      AttemptKind::inside,       AttemptKind::free_minimum,  AttemptKind::free_inside,
      AttemptKind::on_equations, AttemptKind::in_31_digits,  AttemptKind::facial_reduction};
  const Attempt* holding = nullptr;
  const Attempt* first = nullptr;
  for (const AttemptKind kind : kWorth) {
    const Attempt* attempt = find(kind);
    if (attempt == nullptr || !attempt->point) continue;
    if (is_yes(*attempt)) return attempt;
    if (holding == nullptr && attempt->holds()) holding = attempt;
    if (first == nullptr) first = attempt;
  }
  return holding != nullptr ? holding : first;
}

const Attempt* Attempts::refutation() const {
  const Attempt* first = nullptr;
  for (const auto& [kind, attempt] : tried_) {
    if (!attempt.refuted()) continue;
    if (attempt.refutation->exact) return &attempt;
    if (first == nullptr) first = &attempt;
  }
  return first;
}

const Attempt& Attempts::last() const {
  for (const AttemptKind kind :
       {AttemptKind::in_31_digits, AttemptKind::free_inside, AttemptKind::inside})
    if (const Attempt* attempt = find(kind)) return *attempt;
  return tried_.begin()->second;
}

bool Attempts::is_yes(const Attempt& attempt) const {
  return attempt.holds() && (!is_free(attempt) || attempt.reached_gain <= bounds_.beta);
}

bool Attempts::is_free(const Attempt& attempt) const {
  return !bounds_.list.empty() && attempt.question.bounds.list.empty();
}

}  // namespace gainsmith::design
