#include "design/minimum.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "lmi/correlation.h"

namespace gainsmith::design {

bool is_finite(const std::vector<double>& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

bool is_positive(const Posed& posed, const std::vector<double>& x) {
  constexpr double kTells = 1e-15;  // what double tells from 0
  return is_finite(x) && std::all_of(posed.lmi.blocks.begin(), posed.lmi.blocks.end(),
                                     [&](const lmi::Block& block) {
                                       return lmi::correlation_margin(block.value(x)) > kTells;
                                     });
}

double price_of(const Posed& posed, const lmi::GainBounds& bounds,
                const lmi::Formulation& formulation, const sdp::Solution& solution) {
  const double value = posed.lmi.objective_at(lmi::read_back(posed.lmi, formulation, solution));
  const double least = lmi::objective_lower_bound(posed.lmi, bounds, formulation, solution);
  return (value - least) / std::abs(value);
}

namespace {

struct Minimum {
  lmi::Formulation formulation;
  sdp::Solution solution;
};

/// The steps of minimum.h. A minimum is rated by two things: whether its point is positive definite
/// in all blocks, then by its price.
class Refinement {
 public:
  Refinement(const Posed& posed, const Question& asked, const Solve& solve)
      : posed_(posed), asked_(asked), solve_(solve) {}

  /// The best one; none: it is the given one.
  std::optional<Minimum> operator()(const Minimum& given) {
    best_ = &given;
    rate(given);
    if (is_good()) return std::nullopt;
    const Minimum near = with_weight(given);
    take_if_better(in_units_of(is_near_optimal(near.solution) ? near : given));
    if (!is_good() && kCheap < price_ && price_ < kDear) take_if_better(with_finer_gap(*best_));
    return std::move(better_);
  }

 private:
  static constexpr double kDear = 1e-3;  // dearer is no matter of the solver's digits

  double value_of(const Minimum& minimum) const {
    return posed_.lmi.objective_at(
        lmi::read_back(posed_.lmi, minimum.formulation, minimum.solution));
  }

  bool is_good() const { return is_point_ && price_ <= kCheap; }

  /// Sets is_point_ and price_.
  void rate(const Minimum& minimum) {
    is_point_ =
        minimum.solution.status == sdp::Status::optimal &&
        is_positive(posed_, lmi::read_back(posed_.lmi, minimum.formulation, minimum.solution));
    price_ = price_of(posed_, asked_.bounds, minimum.formulation, minimum.solution);
  }

  /// A point before none, the cheaper of two.
  /// Iterations of both are counted.
  void take_if_better(std::optional<Minimum> other) {
    if (!other || other->solution.status != sdp::Status::optimal) return;
    const bool was_point = is_point_;
    const double price = price_;
    rate(*other);
    if (is_point_ != was_point ? is_point_ : price_ < price) {
      other->solution.iterations += best_->solution.iterations;
      better_ = std::move(other);
      best_ = &*better_;
      return;
    }
    is_point_ = was_point;
    price_ = price;
  }

  Minimum solved(lmi::Formulation formulation, const Effort& effort) const {
    lmi::assemble(posed_.lmi, asked_.bounds, {}, formulation);
    sdp::Solution solution = solve_(formulation.problem, effort);
    return {std::move(formulation), std::move(solution)};
  }

  /// In units of the data; its price is no matter.
  Minimum with_weight(const Minimum& given) const {
    constexpr double kWeight = 1e-8;
    lmi::Formulation formulation = given.formulation;
    formulation.weight = kWeight;
    return solved(std::move(formulation), asked_.effort);
  }

  /// None where the solution has no number.
  /// The second line of minimum.h's list. The weight w is such that w sum_k tr(B_k), with blocks
  /// near 1, is a hundredth of a cheap price.
  std::optional<Minimum> in_units_of(const Minimum& near) const {
    constexpr double kPart = 0.01;
    const double value = value_of(near);
    if (!is_finite(near.solution.x) || !std::isfinite(value)) return std::nullopt;
    lmi::Formulation formulation =
        lmi::in_units_of_solution(posed_.lmi, asked_.bounds, near.formulation, near.solution.x);
    // What is above the default is wished for, whatever it costs.
    // A margin above the default is the user's; the default one is as large as costs little.
    if (asked_.shift <= model::SynthesisOptions{}.margin)
      formulation.shift = cheap_shift(near, formulation.balance);
    // The traces of the blocks are not above their numbers of rows.
    formulation.weight = kPart * kCheap * std::abs(value) * formulation.cost_unit /
                         std::accumulate(formulation.sizes.begin(), formulation.sizes.end(), 0);
    return solved(std::move(formulation), asked_.effort);
  }

  /// The shift that costs kPart kCheap of the objective in other units: to first order a shift t
  /// raises the minimum by t sum_k tr(Y_k), with Y_k in these units.
  double cheap_shift(const Minimum& near, const lmi::Balance& units) const {
    constexpr double kPart = 0.3;
    constexpr double kLeast = 1e-13;  // less is no margin beside rounding
    constexpr double kMost = 1e-8;    // more than the solver leaves undone
    double trace = 0;
    for (std::size_t k = 0; k < posed_.lmi.blocks.size(); ++k) {
      const std::vector<int>& kept = near.formulation.free_variables.kept[k];
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const double unit = near.formulation.balance.row(k, kept[i]) / units.row(k, kept[i]);
        trace += near.solution.Y.values[k][i * (kept.size() + 1)] * unit * unit;
      }
    }
    const double cheap = kPart * kCheap * std::abs(value_of(near)) * near.formulation.cost_unit;
    return trace > 0 ? std::clamp(cheap / trace, kLeast, kMost) : kMost;
  }

  Minimum with_finer_gap(const Minimum& of) const {
    // Of the gap that was asked for.
    constexpr double kFiner = 1e-3;
    Effort finer = asked_.effort;
    finer.tolerance *= kFiner;
    return {of.formulation, solve_(of.formulation.problem, finer)};
  }

  const Posed& posed_;
  const Question& asked_;
  const Solve& solve_;
  const Minimum* best_ = nullptr;  ///< `better_`, or the given one
  std::optional<Minimum> better_;
  bool is_point_ = false;  ///< of the best one, as its price
  double price_ = 0;
};

}  // namespace

void refine_minimum(const Posed& posed, const Solve& solve, Attempt& result) {
  Minimum given{std::move(result.formulation), std::move(result.solution)};
  std::optional<Minimum> better = Refinement(posed, result.question, solve)(given);
  Minimum& best = better ? *better : given;
  result.formulation = std::move(best.formulation);
  result.solution = std::move(best.solution);
}

}  // namespace gainsmith::design
