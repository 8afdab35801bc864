// A problem whose data are values and whose names have shapes: what every room works on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "numbers/real.h"
#include "expr/scope.h"
#include "model/problem.h"
#include "model/unknown_function.h"

namespace gainsmith::model {

/// An unknown matrix.
struct UnknownMatrix {
  std::string name;
  expr::Shape shape;
  Structure structure = Structure::full;

  bool operator==(const UnknownMatrix&) const = default;
};

struct Instance {
  const Problem* problem = nullptr;  ///< outlives the instance
  const Method* method = nullptr;
  Overrides overrides;  ///< the values that replaced those of the problem

  Dimensions dimensions;
  numbers::Values data;        ///< the problem's or the method's default
  numbers::Values parameters;  ///< 1 x 1
  /// Data and parameters as symbols with values; `let`, outputs, signals and unknown functions as
  /// definitions.
  expr::Scope scope;
  std::vector<UnknownMatrix> unknowns;     ///< of an unknown function its coefficients
  std::vector<UnknownFunction> functions;  ///< the unknowns that are functions of a scalar
  std::vector<std::pair<std::string, expr::Shape>> states;  ///< plant first, then observer

  /// The scope with the unknowns as symbols: what `require`, `minimize` and `gains` may use.
  expr::Scope design_scope() const;
  /// The scope with unknowns, gains, states and the timer as symbols, and gains that are functions
  /// as definitions: what flow and jump maps and claims may use.
  expr::Scope simulation_scope() const;
  /// Data and parameters together.
  numbers::Values known_values() const;
};

/// Finds dimensions, data, parameters and shapes and checks the method's assumptions. An overridden
/// scalar has that value whatever the problem gives; defaults that use it follow. A scalar that is
/// searched and has neither value nor default stands at the end of its range from which the search
/// goes: the high one of `smallest`, otherwise the low one. InputError for a
/// datum that is missing, has the wrong shape or is not symmetric where it must be, for an
/// assumption that fails (at the place of the datum), for unknown names, and for an override that
/// names no scalar datum or parameter or is not finite.
Instance make_instance(const Problem& problem, const Overrides& overrides = {});

/// The ends of a range as numbers. InputError at its place unless low < high and both are finite.
std::pair<double, double> ends_of(const ScalarRange& range, const expr::Scope& scope,
                                  const numbers::Values& values);

/// The parameters that the problem gives no value and the method a range: synthesis looks for them.
std::vector<ScalarRange> open_parameters(const Problem& problem);

/// The names of the scalar data and the parameters of a method, in its order: what may be
/// overridden.
std::vector<std::string> scalar_names(const Method& method);

/// InputError at `place` when `name` is none of scalar_names, with the nearest that is.
void check_scalar_name(const Method& method, const std::string& name, const Place& place);

/// Compiles everything that the method and the problem say, without solving: flow and jump maps,
/// claims, gains, the campaign and the expectations. InputError for the first that does not fit.
void check_everything(const Instance& instance);

/// The program of a gain's formula; the variable of a function is an input.
expr::Program compile_gain(const Gain& gain, expr::Scope scope);

/// The shapes of the gains, in order; of a function that of its values.
std::vector<std::pair<std::string, expr::Shape>> gain_shapes(const Instance& instance);

/// The value of an expression that must be a scalar given by `values`.
double scalar_value(const expr::Expression& expression, const expr::Scope& scope,
                    const numbers::Values& values);

/// The program of a problem's datum, initial value or expectation; a flat list becomes a column
/// where a column is expected.
expr::Program compile_value(const Value& value, const expr::Scope& scope,
                            std::optional<expr::Shape> expected);

/// The value of such a program.
numbers::Matrix matrix_value(const Value& value, const expr::Scope& scope, const numbers::Values& values,
                          std::optional<expr::Shape> expected);

}  // namespace gainsmith::model
