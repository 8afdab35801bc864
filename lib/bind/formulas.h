// Internal to bind: texts as programs with their places. What is compiled may throw InputError as
// expr::compile() does.
#pragma once

#include <optional>

#include "expr/binding/compile.h"
#include "expr/binding/scope.h"
#include "model/design.h"
#include "model/formula.h"
#include "model/problem.h"

namespace gainsmith::bind {

/// n x 1 with n > 1: a number is none.
bool is_proper_column(expr::Shape shape);

/// A flat list is a row; where a column is declared it is turned.
expr::Expression oriented(const model::Value& value, bool column);

/// `expected`: the shape of the value, which I and 0 take.
model::Formula formula(const expr::Expression& expression, const expr::Scope& scope,
                       std::optional<expr::Shape> expected = std::nullopt);
/// A 1 x 1 one.
model::Formula scalar(const expr::Expression& expression, const expr::Scope& scope);
/// A value that may be a flat list, which is a column where a column is expected.
model::Formula value(const model::Value& value, const expr::Scope& scope,
                     std::optional<expr::Shape> expected);
/// InputError where a center and its deviation or covariance do not fit what has the shape.
void check_spread(const std::vector<model::Formula>& values, bool covariance, expr::Shape of,
                  const std::string& what);
/// Both ends as formulas; they are evaluated and compared later.
model::Range range(const model::ScalarRange& range, const expr::Scope& scope);

}  // namespace gainsmith::bind
