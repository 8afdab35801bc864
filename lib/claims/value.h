// What a claim speaks of, at the samples of a run, with an error bound.
//
// Most claims are quadratic in the coordinates with factors that depend on the timer and on clocks,
//
//   v(x, tau) = sum_m g_m(tau) [x; 1]' Q_m [x; 1],
//
// found from the text (bounded/polynomial.h); the Q_m are formed in 100 digits and rounded once.
// Any other function is evaluated over balls (bounded/ball.h).
#pragma once

#include <optional>
#include <vector>

#include "bounded/bounded_run.h"
#include "bounded/coordinates.h"

namespace gainsmith::claims {

/// One term of a function that is quadratic in the coordinates.
struct QuadraticPart {
  std::optional<expr::Program> factor;   ///< of the timer and clocks; none: 1
  numbers::MatrixOf<Decimal100> matrix;  ///< symmetric, of [x; 1]
};

/// A function in the coordinates; `parts` is empty when it is not quadratic.
struct JudgedFunction {
  expr::Program program;
  std::vector<QuadraticPart> parts;
  bool quadratic = false;
  /// False: it keeps its value along flows, or over jumps, to the last bit.
  bool varies_in_flow = true;
  bool varies_in_jump = true;

  bool varies(bool jump) const { return jump ? varies_in_jump : varies_in_flow; }

  /// Quadratic with constant coefficients: its integral over a flow is a quadratic form too.
  bool is_form() const {
    return quadratic && (parts.empty() || (parts.size() == 1 && !parts.front().factor));
  }
};

JudgedFunction make_function(const expr::Program& program, const bounded::Coordinates& coordinates);

/// Its value at a sample. Not a number where it has none. The function and the system must outlive
/// it; one for each thread.
template <class Scalar>
class Value {
 public:
  Value(const JudgedFunction& function, const bounded::BoundedSystem<Scalar>& system);
  Value(Value&&) noexcept = default;
  Value& operator=(Value&&) noexcept = default;

  bounded::Bounded<Scalar> operator()(const bounded::Track<Scalar>& track, std::size_t sample);

 private:
  struct Part {
    bounded::Form<Scalar> form;
    std::optional<bounded::BallFunction<Scalar>> factor;
  };
  bounded::Bounded<Scalar> quadratic(const bounded::Track<Scalar>& track, std::size_t sample);

  const JudgedFunction* function_;
  std::vector<Eigen::Index> elements_;  ///< those that the forms use
  bounded::ColumnOf<Scalar> x_;
  Eigen::VectorXd r_;
  std::vector<Part> parts_;
  std::optional<bounded::BallFunction<Scalar>> whole_;
};

}  // namespace gainsmith::claims
