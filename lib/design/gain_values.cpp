#include "design/gain_values.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "expr/compile.h"
#include "lmi/compile.h"
#include "model/stated.h"

namespace gainsmith::design {

namespace {

/// Whether every input but `free` has a value.
bool has_values(const expr::Program& program, const numbers::Values& values,
                const std::string& free = "") {
  return std::all_of(program.inputs.begin(), program.inputs.end(), [&](const expr::Input& input) {
    return input.name == free || values.contains(input.name);
  });
}

/// The coefficients of 1, t, t^2, ... of a function of t; none when it is no polynomial.
std::optional<std::vector<numbers::Matrix>> polynomial(const expr::Program& program,
                                                    const std::string& variable,
                                                    const numbers::Values& values) {
  const lmi::Unknowns none{model::Instance{}};
  lmi::MonomialTable monomials(lmi::free_variable(variable));
  lmi::AffineForm form;
  try {
    form = lmi::evaluate_affine(program, none, monomials, values);
  } catch (const InputError&) {
    return std::nullopt;  // more than sums and products of the functions that monomials stand for
  }
  std::vector<numbers::Matrix> coefficients;
  for (const auto& [key, matrix] : form.terms) {
    const lmi::Monomial& monomial = monomials[key.first];
    const lmi::Atom atom = monomial.empty() ? lmi::Atom{} : monomial.front().atom;
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

/// Whether the program uses an unknown function that is given by other weights than powers.
bool uses_vertices(const model::Instance& instance, const expr::Program& program) {
  return std::any_of(instance.functions.begin(), instance.functions.end(),
                     [&](const model::UnknownFunction& function) {
                       return program.uses(function.coefficients.front()) &&
                              !is_polynomial(function);
                     });
}

}  // namespace

void add_gain_values(const model::Instance& instance, const numbers::Values& values,
                     model::Gains& gains) {
  using Kind = model::GainFunction::Kind;
  const expr::Scope scope = instance.design_scope();
  for (const model::Gain& gain : instance.method->gains) {
    const expr::Program program = model::compile_gain(gain, scope);
    const bool known =
        std::all_of(program.inputs.begin(), program.inputs.end(), [&](const expr::Input& input) {
          return input.name == gain.variable || values.contains(input.name);
        });
    if (!known) continue;
    if (gain.variable.empty() || !program.uses(gain.variable)) {
      gains.gains.emplace_back(gain.name, numbers::evaluate(program, values));
      continue;
    }
    auto coefficients = polynomial(program, gain.variable, values);
    if (coefficients && coefficients->size() == 1) {
      gains.gains.emplace_back(gain.name, coefficients->front());
      continue;
    }
    const Kind kind = coefficients                       ? Kind::polynomial
                      : uses_vertices(instance, program) ? Kind::vertices
                                                         : Kind::formula;
    gains.gain_functions.push_back(
        {gain.name, gain.variable, kind, gain.value.text->str(),
         coefficients ? std::move(*coefficients) : std::vector<numbers::Matrix>{}});
  }
}

void add_report(const model::Instance& instance, model::Gains& gains) {
  if (instance.method->report.empty()) return;
  const model::Stated stated = model::state(instance, gains);
  for (const model::Named& value : instance.method->report) {
    const expr::Program program = expr::compile(value.value, stated.scope);
    if (has_values(program, stated.values))
      gains.report.emplace_back(value.name, numbers::evaluate(program, stated.values));
  }
}

}  // namespace gainsmith::design
