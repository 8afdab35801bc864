#include "model/stated.h"

#include <algorithm>
#include <utility>

#include "expr/parser.h"

namespace gainsmith::model {

namespace {

/// The number of matrices name_0, name_1, ... that the file gives.
std::size_t count_coefficients(const std::string& name, const Gains& gains) {
  std::size_t count = 0;
  while (gains.find(coefficient_name(name, count)) != nullptr) ++count;
  return count;
}

[[noreturn]] void refuse_missing_coefficients(const UnknownFunction& function, const Gains& gains) {
  throw InputError({gains.file}, "the gain file lacks the coefficients " +
                                     coefficient_name(function.name, 0) + ", ... of " +
                                     function.signature());
}

class Builder {
 public:
  Builder(const Instance& instance, const Gains& gains)
      : instance_(with_functions(instance, gains)), gains_(gains) {
    stated_.scope = instance_.simulation_scope();
    stated_.values = instance_.known_values();
  }

  Stated build() {
    for (const auto& [name, value] : gains_.parameters)
      if (instance_.parameters.contains(name)) take(name, {}, value);
    for (const UnknownMatrix& unknown : instance_.unknowns)
      if (const numbers::Matrix* value = gains_.find(unknown.name))
        take(unknown.name, unknown.shape, *value);
    const auto shapes = gain_shapes(instance_);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      add_gain(instance_.method->gains[i], shapes[i].second);
    return std::move(stated_);
  }

 private:
  void take(const std::string& name, expr::Shape shape, const numbers::Matrix& value) {
    const expr::Shape found{static_cast<int>(value.rows()), static_cast<int>(value.cols())};
    if (found != shape)
      throw InputError({gains_.file}, name + " in the gain file is " + to_string(found) +
                                          ", expected " + to_string(shape));
    if (!value.allFinite())
      throw InputError({gains_.file}, name + " in the gain file is not finite");
    stated_.values.insert_or_assign(name, value);
  }

  void add_gain(const Gain& gain, expr::Shape shape) {
    const numbers::Matrix* value = gains_.find(gain.name);
    if (gain.variable.empty()) {
      if (value != nullptr) take(gain.name, shape, *value);
      return;
    }
    if (value != nullptr) return add_polynomial(gain.name, gain.variable, shape, {*value});
    for (const GainFunction& function : gains_.gain_functions) {
      if (function.name != gain.name) continue;
      if (function.kind == GainFunction::Kind::polynomial)
        return add_polynomial(gain.name, function.variable, shape, function.coefficients);
      define(gain.name, function.variable, function.formula);
      if (const expr::Shape found = defined_shape(gain.name); found != shape)
        throw InputError({gains_.file}, gain.name + " in the gain file is " + to_string(found) +
                                            ", expected " + to_string(shape));
    }
  }

  void add_polynomial(const std::string& name, const std::string& variable, expr::Shape shape,
                      const std::vector<numbers::Matrix>& coefficients) {
    if (coefficients.empty())
      throw InputError({gains_.file}, name + " in the gain file has no coefficients");
    define(name, variable,
           polynomial_text(name, variable, static_cast<int>(coefficients.size()) - 1));
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      const std::string coefficient = coefficient_name(name, k);
      stated_.scope.symbols[coefficient] = {shape, std::nullopt};
      take(coefficient, shape, coefficients[k]);
    }
  }

  void define(const std::string& name, const std::string& variable, const std::string& text) {
    stated_.scope.definitions[name] = {{variable},
                                       expr::parse(expr::Text::generated(text, {gains_.file}))};
  }

  expr::Shape defined_shape(const std::string& name) const {
    const expr::Definition& definition = stated_.scope.definitions.at(name);
    return compile_gain({name, definition.body, {gains_.file}, definition.parameters.front()},
                        stated_.scope)
        .shape();
  }

  Instance instance_;
  const Gains& gains_;
  Stated stated_;
};

}  // namespace

Instance with_functions(Instance instance, const Gains& gains) {
  for (const auto& [key, text] : gains.functions) {
    const auto known = std::find_if(
        instance.functions.begin(), instance.functions.end(),
        [&, wanted = key](const UnknownFunction& f) { return f.signature() == wanted; });
    if (known == instance.functions.end())
      throw InputError({gains.file}, "the gain file defines " + key +
                                         ", which is no unknown function of the method");
    const std::string name = known->name;
    const std::size_t count = count_coefficients(name, gains);
    if (count == 0 && gains.unknowns.empty()) continue;  // there is no point
    if (count == 0) refuse_missing_coefficients(*known, gains);
    redefine(instance, name, count, text, {gains.file});
  }
  return instance;
}

Stated state(const Instance& instance, const Gains& gains) {
  return Builder(instance, gains).build();
}

}  // namespace gainsmith::model
