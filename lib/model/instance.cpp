#include "model/instance.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "model/names.h"
#include "model/structure.h"

namespace gainsmith::model {

std::vector<const Design::Datum*> in_order(const Design& design) {
  std::vector<const Design::Datum*> order;
  const auto add = [&](const std::vector<Design::Datum>& list, bool first) {
    for (const Design::Datum& datum : list)
      if (datum.first == first) order.push_back(&datum);
  };
  add(design.parameters, true);
  add(design.data, false);
  add(design.parameters, false);
  return order;
}

numbers::Matrix value_of(const Design& design, const Design::Datum& datum,
                         const Overrides& overrides, const numbers::Values& values) {
  const auto overridden = overrides.find(datum.name);
  if (overridden != overrides.end()) return numbers::Matrix::Constant(1, 1, overridden->second);
  if (!datum.value) throw InputError({design.file}, datum.missing);
  if (datum.range) ends_of(*datum.range, values);
  numbers::Matrix matrix = numbers::evaluate(datum.value->program, values);
  enforce_structure(datum, matrix);
  return matrix;
}

void check_assumption(const Design& design, const Design::Assumption& assumption,
                      const numbers::Values& values) {
  for (const auto& [program, strict] : assumption.differences) {
    const numbers::Matrix difference = numbers::evaluate(program, values);
    if (difference.size() == 1 && (strict ? difference(0, 0) > 0 : difference(0, 0) >= 0)) continue;
    std::string found;
    for (const std::string& name : assumption.scalars)
      found += (found.empty() ? "" : ", ") + name + " = " + brief(values.at(name)(0, 0));
    const Place place = assumption.place.file.empty() ? Place{design.file} : assumption.place;
    throw InputError(place, (found.empty() ? "" : found + ": ") + "expected " + assumption.text +
                                ", the assumption '" + assumption.name + "'");
  }
}

bool chooses_basis(const expr::Program& program) {
  return std::any_of(program.code.begin(), program.code.end(), [](const auto& instruction) {
    return instruction.op == expr::Op::range_basis || instruction.op == expr::Op::kernel_basis;
  });
}

numbers::Values values_with(const Instance& instance, const numbers::Values& bases) {
  const bool same = std::all_of(bases.begin(), bases.end(), [&](const auto& basis) {
    return instance.values.at(basis.first) == basis.second;
  });
  if (same) return instance.values;
  numbers::Values values;
  for (const Design::Datum* datum : in_order(*instance.design)) {
    const auto given = bases.find(datum->name);
    values[datum->name] = given != bases.end()
                              ? given->second
                              : value_of(*instance.design, *datum, instance.overrides, values);
  }
  return values;
}

std::vector<Function> polynomials(const Design& design) {
  std::vector<Function> functions;
  for (const Design::Unknown& unknown : design.unknowns)
    if (!unknown.variable.empty())
      functions.push_back({unknown.name, unknown.variable, unknown.shape, unknown.structure,
                           basis_of(unknown, static_cast<std::size_t>(unknown.degree) + 1),
                           unknown.place});
  return functions;
}

std::vector<UnknownMatrix> unknown_matrices(const Design& design,
                                            const std::vector<Function>& functions) {
  std::vector<UnknownMatrix> matrices;
  for (const Design::Unknown& unknown : design.unknowns) {
    if (unknown.variable.empty()) {
      matrices.push_back({unknown.name, unknown.shape, unknown.structure});
      continue;
    }
    for (const Function& function : functions)
      if (function.name == unknown.name)
        for (const std::string& coefficient : function.coefficients())
          matrices.push_back({coefficient, unknown.shape, unknown.structure});
  }
  return matrices;
}

bool has_values(const expr::Program& program, const numbers::Values& values,
                const std::string& free) {
  return std::all_of(program.inputs.begin(), program.inputs.end(), [&](const expr::Input& input) {
    return input.name == free || values.contains(input.name);
  });
}

double scalar_value(const Formula& formula, const numbers::Values& values) {
  return numbers::evaluate(formula.program, values)(0, 0);
}

std::optional<double> scalar_named(const Instance& instance, const std::string& name) {
  const auto found = instance.values.find(name);
  if (found != instance.values.end()) return found->second(0, 0);
  return instance.design->synthesis.gain_bound;
}

void override_gain_bound(Design& design, const Overrides& overrides,
                         const numbers::Values& values) {
  const auto bound = overrides.find(kGainBound);
  if (bound == overrides.end() || values.contains(kGainBound)) return;
  if (!(bound->second > 0))
    throw InputError({design.file}, std::string(kGainBound) + ": expected a positive number");
  design.synthesis.set_gain_bound(bound->second);
}

std::pair<double, double> ends_of(const Range& range, const numbers::Values& values) {
  const double low = scalar_value(range.low, values);
  const double high = scalar_value(range.high, values);
  if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
    throw InputError(range.place, range.name +
                                      ": expected a range [low, high] with low < high, found [" +
                                      brief(low) + ", " + brief(high) + "]");
  return {low, high};
}

}  // namespace gainsmith::model
