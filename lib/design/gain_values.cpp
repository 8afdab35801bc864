#include "design/gain_values.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/named.h"
#include "base/scalars.h"
#include "bind/stated.h"
#include "lmi/affine.h"
#include "model/stated.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {

namespace {

/// The coefficients of 1, t, t^2, ... of a function of t; none when it is no polynomial.
std::optional<std::vector<numbers::Matrix>> polynomial(const expr::Program& program,
                                                       const std::string& variable,
                                                       const numbers::Values& values) {
  forall::MonomialTable monomials(forall::free_variable(variable));
  lmi::AffineForm form;
  try {
    form = lmi::evaluate_affine(program, lmi::Unknowns{}, monomials, values);
  } catch (const InputError&) {
    return std::nullopt;  // more than sums and products of the functions that monomials represent
  }
  std::vector<numbers::Matrix> coefficients;
  for (const auto& [key, matrix] : form.terms) {
    // Exponentials and waves are no polynomials.
    const forall::Monomial& monomial = monomials[key.first];
    const forall::Atom atom = monomial.empty() ? forall::Atom{} : monomial.front().atom;
    if (atom.rate != 0 || atom.frequency != 0) return std::nullopt;
    const auto power = static_cast<std::size_t>(atom.power);
    if (power >= coefficients.size())
      coefficients.resize(power + 1, numbers::Matrix::Zero(form.shape.rows, form.shape.cols));
    coefficients[power] = numbers::Matrix(matrix);
  }
  if (coefficients.empty())
    coefficients.emplace_back(numbers::Matrix::Zero(form.shape.rows, form.shape.cols));
  return coefficients;
}

/// Whether the formula calls an unknown function in this basis.
/// Such gains are told in their own basis.
bool calls(const lmi::Inequalities& inequalities, const expr::Program& formula,
           model::Basis::Kind basis) {
  return std::any_of(inequalities.functions.begin(), inequalities.functions.end(),
                     [&](const model::Function& function) {
                       return function.basis.kind == basis &&
                              has_named(formula.functions, function.name);
                     });
}

}  // namespace

numbers::Matrix gain_value(const expr::Program& formula, const numbers::Values& values) {
  // A basis is one of many: the gains have that of the file.
  if (!model::chooses_basis(formula)) try {
      numbers::ValuesOf<Decimal100> wide;
      for (const expr::Input& input : formula.inputs)
        if (const auto value = values.find(input.name); value != values.end())
          wide[input.name] = value->second.cast<Decimal100>();
      return numbers::evaluate<Decimal100>(formula, wide).unaryExpr([](const Decimal100& v) {
        return as<double>(v);
      });
    } catch (const expr::EvaluationError&) {
    }
  return numbers::evaluate(formula, values);
}

void add_gain_values(const lmi::Inequalities& inequalities, const numbers::Values& values,
                     model::Gains& gains) {
  using Kind = model::GainFunction::Kind;
  for (const model::Design::Gain& gain : inequalities.design().gains) {
    const expr::Program program = inequalities.bodies.link(gain.formula.program);
    if (!model::has_values(program, values, gain.variable)) continue;
    if (gain.variable.empty() || !program.uses(gain.variable)) {
      gains.gains.emplace_back(gain.name, gain_value(program, values));
      continue;
    }
    using Basis = model::Basis::Kind;
    // Powers would lose the digits of the basis.
    auto coefficients = calls(inequalities, gain.formula.program, Basis::chebyshev)
                            ? std::nullopt
                            : polynomial(program, gain.variable, values);
    if (coefficients && coefficients->size() == 1) {
      gains.gains.emplace_back(gain.name, coefficients->front());
      continue;
    }
    const Kind kind = coefficients                                                ? Kind::polynomial
                      : calls(inequalities, gain.formula.program, Basis::weights) ? Kind::vertices
                                                                                  : Kind::formula;
    gains.gain_functions.push_back(
        {gain.name, gain.variable, kind, gain.formula.text,
         coefficients ? std::move(*coefficients) : std::vector<numbers::Matrix>{}});
  }
}

double largest_gain(const lmi::Inequalities& inequalities, const numbers::Values& values) {
  // Pieces of an interval.
  constexpr int kPoints = 64;
  double largest = 0;
  double share = 1;
  const auto meet = [&](const expr::Program& program, const numbers::Values& at) {
    try {
      const numbers::Matrix gain = numbers::evaluate(program, at);
      if (gain.size() > 0) largest = std::max(largest, numbers::singular_values(gain)[0] / share);
    } catch (const expr::EvaluationError&) {
      largest = std::numeric_limits<double>::infinity();
    }
  };
  for (const model::Design::Gain& gain : inequalities.design().gains) {
    const auto bounded = inequalities.design().synthesis.share_of_bound(gain.name);
    if (!bounded) continue;
    share = *bounded;
    const expr::Program program = inequalities.bodies.link(gain.formula.program);
    if (!model::has_values(program, values, gain.variable)) continue;
    if (gain.variable.empty() || !program.uses(gain.variable)) {
      meet(program, values);
      continue;
    }
    for (const lmi::Statement& statement : inequalities.statements)
      for (const forall::Variable& variable : statement.domain) {
        if (variable.name != gain.variable || !variable.is_interval()) continue;
        numbers::Values at = values;
        for (int k = 0; k <= kPoints; ++k) {
          const double t = variable.low + (variable.high - variable.low) * k / kPoints;
          at.insert_or_assign(variable.name, numbers::Matrix::Constant(1, 1, t));
          meet(program, at);
        }
      }
  }
  return largest;
}

void add_report(const model::Instance& instance, model::Gains& gains) {
  for (const auto& [name, estimate] : instance.design->estimates)
    gains.estimates[name] = to_string(estimate);
  if (instance.design->report.empty()) return;
  const model::Stated stated = bind::state(instance, gains);
  for (const model::NamedFormula& shown : instance.design->report) {
    const expr::Program& program = shown.value.program;
    std::optional<numbers::Matrix> value;
    try {
      value = stated.value(program);
    } catch (const expr::EvaluationError& error) {
      gains.not_computed[shown.name] = error.message();
    }
    if (!value) continue;
    gains.report.emplace_back(shown.name, *value);
    if (program.code[static_cast<std::size_t>(program.result)].op == expr::Op::eigenvalues)
      gains.eigenvalues.insert(shown.name);
  }
}

}  // namespace gainsmith::design
