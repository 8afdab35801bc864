#include "bind/instance.h"

#include <algorithm>
#include <cmath>

#include "bind/binding.h"
#include "model/names.h"

namespace gainsmith::bind {

namespace {

/// The values of an instance, in the order of the declarations.
/// Data, parameters and assumptions, evaluated and checked anew without their texts.
class Evaluation {
 public:
  Evaluation(const model::Design& design, const model::Overrides& overrides)
      : design_(design), overrides_(overrides) {}

  numbers::Values run() {
    check_overrides();
    for (const model::Design::Datum* datum : in_order(design_))
      values_[datum->name] = value_of(design_, *datum, overrides_, values_);
    for (const model::Design::Assumption& assumption : design_.assumptions)
      check_assumption(design_, assumption, values_);
    for (const model::Design::Unknown& unknown : design_.unknowns)
      if (unknown.in) ends_of(*unknown.in, values_);
    return std::move(values_);
  }

 private:
  /// InputError for a name that is no scalar, or a value that is not finite.
  void check_overrides() const {
    for (const auto& [name, value] : overrides_) {
      check_scalar_name(design_, name, {design_.file});
      if (!std::isfinite(value))
        throw InputError({design_.file}, name + ": expected a finite number");
    }
  }

  const model::Design& design_;
  const model::Overrides& overrides_;
  numbers::Values values_;
};

/// Whether all that binding took from values is as it was.
bool has_same_shapes(const model::Design& design, const numbers::Values& values) {
  const auto is_same_degree = [&](const model::Design::Unknown& unknown) {
    return !unknown.degree_formula ||
           scalar_value(*unknown.degree_formula, values) == unknown.degree;
  };
  const numbers::KnownDoubles doubles(values);
  const auto is_same_rank = [&](const model::Design::Rank& known) {
    if (!known.tolerance) return doubles.rank(known.matrix, nullptr) == known.rank;
    return doubles.number(*known.tolerance) >= 0 &&
           doubles.rank(known.matrix, &*known.tolerance) == known.rank;
  };
  const auto has_same_units = [&](const model::Design::Units& known) {
    return doubles.units(known.A, known.C) == known.exponents;
  };
  const auto is_same_plant = [&](const model::Design::Plant& known) {
    return numbers::evaluate(known.matrix, values) == known.value;
  };
  return std::all_of(design.units.begin(), design.units.end(), has_same_units) &&
         std::all_of(design.plants.begin(), design.plants.end(), is_same_plant) &&
         std::all_of(design.unknowns.begin(), design.unknowns.end(), is_same_degree) &&
         std::all_of(design.ranks.begin(), design.ranks.end(), is_same_rank);
}

}  // namespace

/// Programs depend on values by ranks, units, degrees and gains that were found while binding.
/// Where these are as before the programs stay; otherwise the texts are bound anew.
model::Instance evaluate(const model::DesignPtr& design, const model::Overrides& overrides) {
  try {
    numbers::Values values = Evaluation(*design, overrides).run();
    if (has_same_shapes(*design, values)) {
      const model::Instance instance{design, overrides, std::move(values)};
      if (!overrides.contains(model::kGainBound)) return instance;
      return with_design(instance, [&](model::Design& changed) {
        override_gain_bound(changed, overrides, instance.values);
      });
    }
  } catch (const InputError&) {
    // The programs may be those of another rank or unit.
    if (design->ranks.empty() && design->units.empty()) throw;
  }
  return bind_again(*design, overrides);
}

}  // namespace gainsmith::bind
