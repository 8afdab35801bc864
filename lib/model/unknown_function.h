// Unknowns that are functions of a scalar, "YL: {shape: n x p, of: tau, degree: 2}".
//
// The function is a text over coefficient matrices, which are unknowns like any other:
//   YL(tau) = YL_0 + YL_1*tau + YL_2*tau^2
// so inequalities, gains and simulations evaluate the same text. Another way to fill the interval,
// such as one coefficient for each vertex of a box, is another text (redefine).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "expr/program.h"
#include "model/shape_text.h"

namespace gainsmith::model {

struct Instance;

struct UnknownFunction {
  std::string name;      ///< "YL"
  std::string variable;  ///< "tau"
  expr::Shape shape;     ///< of the function and of each coefficient
  Structure structure = Structure::full;
  std::vector<std::string> coefficients;  ///< "YL_0", "YL_1", ...
  std::string text;                       ///< "YL_0 + YL_1*tau"
  Place place;                            ///< of the declaration

  /// "YL(tau)".
  std::string signature() const { return name + "(" + variable + ")"; }
};

/// "YL_2": the coefficient k = 0, 1, ... of the function `name`.
std::string coefficient_name(const std::string& name, std::size_t k);

/// "YL_0 + YL_1*tau + YL_2*tau^2", for `degree` 2.
std::string polynomial_text(const std::string& name, const std::string& variable, int degree);

/// Whether the function is the polynomial of its coefficients.
bool is_polynomial(const UnknownFunction& function);

/// Adds the function as the polynomial of that degree: its coefficients to the instance's unknowns,
/// its definition to the scope. `function` gives name, variable, shape, structure and place.
void add_polynomial(Instance& instance, UnknownFunction function, int degree);

/// Gives the function `name` of the instance `count` coefficients and the definition `text` over
/// them and its variable. InputError, at `place`, when the text does not parse, uses other names or
/// does not have the function's shape; std::logic_error when there is no such function.
void redefine(Instance& instance, const std::string& name, std::size_t count,
              const std::string& text, const Place& place);

}  // namespace gainsmith::model
