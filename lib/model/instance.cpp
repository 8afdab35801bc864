#include "model/instance.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "model/binding.h"
#include "model/structure.h"

namespace gainsmith::model {

namespace {

/// The values of an instance, in the order of the declarations.
class Evaluation {
 public:
  Evaluation(const Design& design, const Overrides& overrides)
      : design_(design), overrides_(overrides) {}

  numbers::Values run() {
    check_overrides();
    for (const auto* list : {&design_.data, &design_.parameters})
      for (const Design::Datum& datum : *list)
        values_[datum.name] = value_of(design_, datum, overrides_, values_);
    for (const Design::Assumption& assumption : design_.assumptions)
      check_assumption(design_, assumption, values_);
    for (const Design::Unknown& unknown : design_.unknowns)
      if (unknown.in) ends_of(*unknown.in, values_);
    return std::move(values_);
  }

 private:
  void check_overrides() const {
    for (const auto& [name, value] : overrides_) {
      check_scalar_name(design_, name, {design_.file});
      if (!std::isfinite(value))
        throw InputError({design_.file}, name + ": expected a finite number");
    }
  }

  const Design& design_;
  const Overrides& overrides_;
  numbers::Values values_;
};

/// Whether all that binding took from values is as it was.
bool has_same_shapes(const Design& design, const numbers::Values& values) {
  const auto is_same_degree = [&](const Design::Unknown& unknown) {
    return !unknown.degree_formula ||
           scalar_value(*unknown.degree_formula, values) == unknown.degree;
  };
  const numbers::KnownDoubles doubles(values);
  const auto is_same_rank = [&](const Design::Rank& known) {
    if (!known.tolerance) return doubles.rank(known.matrix, nullptr) == known.rank;
    return doubles.number(*known.tolerance) >= 0 &&
           doubles.rank(known.matrix, &*known.tolerance) == known.rank;
  };
  return std::all_of(design.unknowns.begin(), design.unknowns.end(), is_same_degree) &&
         std::all_of(design.ranks.begin(), design.ranks.end(), is_same_rank);
}

}  // namespace

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
    throw InputError(place, (found.empty() ? "" : found + ": ") + "expected " + assumption.text);
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
  for (const auto* list : {&instance.design->data, &instance.design->parameters})
    for (const Design::Datum& datum : *list) {
      const auto given = bases.find(datum.name);
      values[datum.name] = given != bases.end()
                               ? given->second
                               : value_of(*instance.design, datum, instance.overrides, values);
    }
  return values;
}

Instance evaluate(const DesignPtr& design, const Overrides& overrides) {
  try {
    numbers::Values values = Evaluation(*design, overrides).run();
    if (has_same_shapes(*design, values)) return {design, overrides, std::move(values)};
  } catch (const InputError&) {
    // The programs may be those of another rank.
    if (design->ranks.empty()) throw;
  }
  return bind_again(*design, overrides);
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
