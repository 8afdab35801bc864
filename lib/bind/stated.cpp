#include "bind/stated.h"

#include <algorithm>
#include <utility>

#include "base/eigen_scalars.h"
#include "base/named.h"
#include "bind/binding.h"
#include "bind/exact_values.h"
#include "bind/gains.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"

namespace gainsmith::bind {

namespace {

/// The number of matrices name_0, name_1, ... that the file gives.
std::size_t count_coefficients(const std::string& name, const model::Gains& gains) {
  std::size_t count = 0;
  while (gains.find(model::coefficient_name(name, count)) != nullptr) ++count;
  return count;
}

/// The polynomial of `count` coefficients.
model::Function polynomial(const std::string& name, const std::string& variable, expr::Shape shape,
                           std::size_t count, const Place& place) {
  return {name,
          variable,
          shape,
          model::Structure::full,
          model::monomials(variable, static_cast<int>(count) - 1, place),
          place};
}

/// Values of a gain file over an instance: bases first, as other data follow from them, then
/// functions, unknowns and gains. What the file has replaces what the problem says.
class Builder {
 public:
  Builder(const model::Instance& instance, const model::Gains& gains)
      : instance_(instance), design_(*instance.design), gains_(gains) {
    stated_.values = instance.values;
  }

  model::Stated build() {
    add_bases();
    add_functions();
    for (const auto& [name, value] : gains_.parameters)
      if (has_named(design_.parameters, name)) take(name, {}, value);
    for (const model::UnknownMatrix& unknown : stated_.unknowns)
      if (const numbers::Matrix* value = gains_.find(unknown.name))
        take(unknown.name, unknown.shape, *value);
    for (const model::Design::Gain& gain : design_.gains) add_gain(gain);
    return std::move(stated_);
  }

 private:
  /// The bases that the gains are in, and the data that follow from them.
  void add_bases() {
    numbers::Values bases;
    for (const auto& [name, basis] : gains_.bases) {
      const auto datum = std::find_if(
          design_.data.begin(), design_.data.end(),
          [&](const model::Design::Datum& known) { return known.name == name && known.chosen; });
      if (datum == design_.data.end())
        throw InputError({gains_.file},
                         "the gain file has a basis " + name +
                             ", which is no datum that takes one by orth, null or output_gain");
      take(name, datum->shape, basis);
      bases[name] = basis;
    }
    stated_.values = values_with(instance_, bases);
  }

  /// The unknown functions as the file defines them, and all unknown matrices.
  void add_functions() {
    std::vector<model::Function> functions = polynomials(design_);
    stated_.bodies = model::Bodies(functions);
    for (const model::StatedFunction& stated : gains_.functions) {
      const auto states = [&](const model::Design::Polynomial& polynomial) {
        return polynomial.signature == stated.signature && polynomial.text == stated.text;
      };
      if (std::ranges::any_of(design_.polynomials, states)) continue;  // a definition of the design
      const auto known =
          std::ranges::find(functions, stated.signature, &model::Function::signature);
      if (known == functions.end())
        throw InputError({gains_.file}, "the gain file defines " + stated.signature +
                                            ", which is no unknown function of the method");
      const std::size_t count = count_coefficients(known->name, gains_);
      if (count == 0 && gains_.unknowns.empty()) continue;  // there is no point
      if (count == 0)
        throw InputError({gains_.file}, "the gain file lacks the coefficients " +
                                            model::coefficient_name(known->name, 0) + ", ... of " +
                                            stated.signature);
      known->basis = basis_of(unknown(known->name), count);
      if (!stated.body && stated.text == known->text())
        stated_.bodies.set(*known);
      else
        stated_.bodies.set(known->name, {known->variable, body_of(*known, stated)});
    }
    stated_.unknowns = unknown_matrices(design_, functions);
  }

  /// The unknown of this name, which the design has.
  const model::Design::Unknown& unknown(const std::string& name) const {
    return *find_named(design_.unknowns, name);
  }

  /// `polynomial` has as many coefficients as the file.
  expr::Program body_of(const model::Function& polynomial,
                        const model::StatedFunction& stated) const {
    if (stated.body) return *stated.body;
    const Place place{gains_.file};
    expr::Scope scope = design_.names->known;
    scope.known = std::make_shared<numbers::KnownDoubles>(instance_.values);
    scope.symbols[polynomial.variable] = {};
    for (const std::string& coefficient : polynomial.coefficients())
      scope.symbols[coefficient] = {polynomial.shape};
    const expr::Program body =
        expr::compile(expr::parse(expr::Text::generated(stated.text, place)), scope);
    if (body.shape() != polynomial.shape)
      throw InputError(place, stated.signature + " is " + to_string(polynomial.shape) + ", but '" +
                                  stated.text + "' is " + to_string(body.shape()));
    return body;
  }

  /// A matrix of the file, of the shape that is expected, and finite.
  void take(const std::string& name, expr::Shape shape, const numbers::Matrix& value) {
    const expr::Shape found = numbers::shape_of(value);
    if (found != shape)
      throw InputError({gains_.file}, name + " in the gain file is " + to_string(found) +
                                          ", expected " + to_string(shape));
    if (!value.allFinite())
      throw InputError({gains_.file}, name + " in the gain file is not finite");
    stated_.values.insert_or_assign(name, value);
  }

  /// The value of the file; of a function its polynomial, its formula, or the formula of the
  /// method.
  void add_gain(const model::Design::Gain& gain) {
    const numbers::Matrix* value = gains_.find(gain.name);
    if (gain.variable.empty()) {
      if (value != nullptr) take(gain.name, gain.shape, *value);
      return;
    }
    if (value != nullptr) return add_polynomial(gain, gain.variable, {*value});
    stated_.bodies.set(gain.name, {gain.variable, gain.formula.program});
    for (const model::GainFunction& function : gains_.gain_functions) {
      if (function.name != gain.name) continue;
      if (function.kind == model::GainFunction::Kind::polynomial)
        return add_polynomial(gain, function.variable, function.coefficients);
      if (function.formula != gain.formula.text || function.variable != gain.variable)
        add_formula(gain, function);
    }
  }

  /// A formula that is not the method's own.
  void add_formula(const model::Design::Gain& gain, const model::GainFunction& function) {
    const Place place{gains_.file};
    expr::Program body =
        bind_gain_formula(instance_, stated_.unknowns, function.formula, function.variable, place);
    if (body.shape() != gain.shape)
      throw InputError(place, gain.name + " in the gain file is " + to_string(body.shape()) +
                                  ", expected " + to_string(gain.shape));
    stated_.bodies.set(gain.name, {function.variable, std::move(body)});
  }

  /// sum_k C_k s^k with the coefficients of the file.
  void add_polynomial(const model::Design::Gain& gain, const std::string& variable,
                      const std::vector<numbers::Matrix>& coefficients) {
    if (coefficients.empty())
      throw InputError({gains_.file}, gain.name + " in the gain file has no coefficients");
    const model::Function function =
        polynomial(gain.name, variable, gain.shape, coefficients.size(), {gains_.file});
    stated_.bodies.set(gain.name, function.body());
    for (std::size_t k = 0; k < coefficients.size(); ++k)
      take(model::coefficient_name(gain.name, k), gain.shape, coefficients[k]);
  }

  const model::Instance& instance_;
  const model::Design& design_;
  const model::Gains& gains_;
  model::Stated stated_;
};

}  // namespace

model::Stated state(const model::Instance& instance, const model::Gains& gains) {
  return Builder(instance, gains).build();
}

/// Values in 31 digits are rounded from those in 100 digits, when a run asks for them.
model::RunTexts run_texts(const model::Instance& instance, const model::Gains& gains) {
  model::RunTexts texts = model::run_texts(*instance.design, state(instance, gains));
  texts.in_31_digits = [instance, gains](const numbers::Values& constants) {
    numbers::ValuesOf<DoubleDouble> values;
    for (const auto& [name, value] : exact_values(instance, constants, gains))
      values[name] = value.unaryExpr([](const Decimal100& x) { return as<DoubleDouble>(x); });
    return values;
  };
  return texts;
}

}  // namespace gainsmith::bind
