// A design with values for its data and parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/design.h"
#include "model/function.h"
#include "numbers/types/real.h"

namespace gainsmith::model {

/// An unknown matrix.
struct UnknownMatrix {
  std::string name;
  expr::Shape shape;
  Structure structure = Structure::full;

  bool operator==(const UnknownMatrix&) const = default;
};

struct Instance {
  DesignPtr design;
  Overrides overrides;     ///< the values that replaced those of the problem
  numbers::Values values;  ///< of data and parameters
};

/// Data and parameters in the order in which they have values: parameters that are numbers, data,
/// other parameters.
std::vector<const Design::Datum*> in_order(const Design& design);

/// The value of a datum or parameter from those before it. InputError where it has none,
/// its range has no ends in order, or it has not the structure that it must have.
numbers::Matrix value_of(const Design& design, const Design::Datum& datum,
                         const Overrides& overrides, const numbers::Values& values);

/// Whether the text takes a basis by `orth` or `null`.
bool chooses_basis(const expr::Program& program);

/// The values of data and parameters, with bases in the place of those that the problem's texts
/// take.
numbers::Values values_with(const Instance& instance, const numbers::Values& bases);

/// InputError when the assumption fails.
void check_assumption(const Design& design, const Design::Assumption& assumption,
                      const numbers::Values& values);

/// The same instance with a changed design: an inequality left out, an objective replaced.
template <class Change>
Instance with_design(Instance instance, Change change) {
  auto changed = std::make_shared<Design>(*instance.design);
  change(*changed);
  instance.design = std::move(changed);
  return instance;
}

/// The unknown functions of a design as polynomials of their declared degree.
std::vector<Function> polynomials(const Design& design);

/// All unknown matrices in the order of the method, those of a function being its coefficients.
std::vector<UnknownMatrix> unknown_matrices(const Design& design,
                                            const std::vector<Function>& functions);

/// Whether every input of a program has a value; `free` is one that needs none.
bool has_values(const expr::Program& program, const numbers::Values& values,
                const std::string& free = "");

/// The value of a 1 x 1 formula.
double scalar_value(const Formula& formula, const numbers::Values& values);

/// The value of a scalar datum or parameter, or of the bound on the gains (kGainBound); none where
/// gains have no bound.
std::optional<double> scalar_named(const Instance& instance, const std::string& name);

/// Sets the bound on the gains where `overrides` has one and no scalar of `values` is meant.
void override_gain_bound(Design& design, const Overrides& overrides, const numbers::Values& values);

/// The ends of a range as numbers. InputError at its place unless low < high and both are finite.
std::pair<double, double> ends_of(const Range& range, const numbers::Values& values);

}  // namespace gainsmith::model
