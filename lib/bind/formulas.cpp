#include "bind/formulas.h"

#include <memory>

namespace gainsmith::bind {

bool is_proper_column(expr::Shape shape) { return shape.cols == 1 && shape.rows > 1; }

expr::Expression oriented(const model::Value& value, bool column) {
  if (!value.flat || !column) return value.value;
  auto turned = std::make_shared<expr::Node>();
  turned->kind = expr::NodeKind::transpose;
  turned->begin = value.value.root->begin;
  turned->end = value.value.root->end;
  turned->children = {value.value.root};
  return {value.value.text, turned};
}

model::Formula scalar(const expr::Expression& expression, const expr::Scope& scope) {
  return formula(expression, scope, expr::Shape{});
}

model::Formula formula(const expr::Expression& expression, const expr::Scope& scope,
                       std::optional<expr::Shape> expected) {
  return {expr::compile(expression, scope, expected), expression.place(*expression.root),
          expression.text->str()};
}

model::Formula value(const model::Value& value, const expr::Scope& scope,
                     std::optional<expr::Shape> expected) {
  model::Formula result =
      formula(oriented(value, expected && is_proper_column(*expected)), scope, expected);
  result.place = value.place;
  return result;
}

/// The deviation has the shape of the value or is a number; the covariance of a column with n
/// elements is n x n. The center has the shape of the value or is a number for all elements.
void check_spread(const std::vector<model::Formula>& values, bool covariance, expr::Shape of,
                  const std::string& what) {
  const expr::Shape center = values[0].program.shape(), spread = values[1].program.shape();
  const bool fits = covariance ? of.cols == 1 && spread == expr::Shape{of.rows, of.rows}
                               : spread == of || spread.is_scalar();
  if (fits && (center == of || center.is_scalar())) return;
  throw InputError(values[fits ? 0 : 1].place,
                   what + " is " + to_string(of) + ": " + to_string(fits ? center : spread) +
                       (covariance && !fits ? " is no covariance of a column" : " does not fit"));
}

model::Range range(const model::ScalarRange& range, const expr::Scope& scope) {
  return {range.name, scalar(range.low, scope), scalar(range.high, scope), range.place};
}

}  // namespace gainsmith::bind
