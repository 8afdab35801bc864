#include "design/convexity.h"

#include <optional>

#include "base/number.h"
#include "numbers/dense/dense.h"
#include "numbers/dense/rational_algebra.h"
#include "verdict/rational_blocks.h"

namespace gainsmith::design {

namespace {

/// By fractions; none where it has none.
std::optional<bool> is_semidefinite(const expr::Program& weight, const model::Instance& instance) {
  try {
    return numbers::is_rational_semidefinite(numbers::rational_symmetric_part(
        numbers::rational_value(weight, verdict::rational_values(instance))));
  } catch (const expr::EvaluationError&) {
    return std::nullopt;
  }
}

}  // namespace

void require_convex(const model::Instance& instance) {
  constexpr double kClearly = 1e-9;  // of the norm: no rounding of the data or of eigenvalues
  for (const model::Design::Square& square : instance.design->squares) {
    const numbers::Matrix Q = numbers::evaluate(square.weight, instance.values);
    // First in double; fractions decide what is near 0.
    const double least = numbers::symmetric_eigenvalues((Q + Q.transpose()) / 2)(0);
    if (least > kClearly * Q.norm()) continue;
    const std::optional<bool> convex = is_semidefinite(square.weight, instance);
    if (convex == true) continue;
    throw InputError(square.place,
                     "'" + square.text + "' is " + (convex ? "not" : "not known to be") +
                         " convex: the smallest eigenvalue of its matrix is " + brief(least, 3) +
                         ", and 0 must be shown; norm(R*e)^2 with Q = R'*R always is");
  }
}

}  // namespace gainsmith::design
