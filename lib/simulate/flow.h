// One flow of a System after the other, in steps with dense output.
//
//   exact        x' = M x + b: at the Chebyshev points of a step, E(s) x + f(s) with [E f; 0 1] =
//                expm(s [M b; 0 0]). Steps have the lengths s_0 2^k, s_0 = 1/(2 ||M||) in units
//                that balance M (numerics/balance.h): after a start they grow as long as the series
//                of degree 12 agrees to rounding, up to 1/w with w the largest |Im| or Re of an
//                eigenvalue, so that nothing is stepped over; without those that die down in a hundred turns.
//   integrated   the steps of an integrator (ode/integrator.h), and their polynomials.
//   in 31 digits  steps of State31 (state_31.h), and polynomials in double through them.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "hybrid/trajectory.h"
#include "simulate/last_places.h"
#include "simulate/state_31.h"
#include "simulate/vector_field.h"

namespace gainsmith::simulate {

/// The error of a step may be relative |x| + absolute, element by element.
struct Accuracy {
  double relative = 1e-10;
  double absolute = 1e-10;
  Eigen::VectorXd absolute_of{};  ///< of each element of the variables; empty: `absolute` of all
  double longest = 1;             ///< step, as a part of the longest one of a run and of each flow
  bool in_31_digits = false;      ///< then to that, whatever the others say (state_31.h)

  /// All errors times a factor; below 1e-13 relative nothing is gained. A sharper run takes shorter
  /// steps even where errors do not ask for them: equal steps of two runs have equal errors, and
  /// their difference would say nothing.
  Accuracy times(double factor) const;
};

class Flow {
 public:
  virtual ~Flow() = default;

  /// Begins at t, after VectorField::begin there. Nothing is evaluated after `last` but by exact
  /// flows.
  virtual void start(double t, const Eigen::VectorXd& values, double last) = 0;
  /// From the next start on errors count as absolute below `part` of the accuracy's: flows that
  /// shrink lead to values that shrink with them.
  virtual void sharpen(double part) { (void)part; }
  /// The step from where the last one ended, at most to `last`. IntegrationError (ode/integrator.h)
  /// where the flow ends before.
  virtual hybrid::DenseStep next() = 0;
  /// The run has come to a time on it.
  virtual void arrive(double t) { (void)t; }
};

/// The flow of the system of a field, which must outlive it; no step is longer than `longest`.
/// `moved`: each step of an exact flow is moved by it in the last places at its end, and not at its
/// start, so that what has just happened does not happen again. Integrated flows to two accuracies
/// differ in rounding by themselves.
std::unique_ptr<Flow> make_flow(VectorField& field, const Accuracy& accuracy, double longest,
                                const LastPlaces* moved = nullptr);
/// In 31 digits; the state must outlive it. `share`: of the lengths that its steps might have.
std::unique_ptr<Flow> flow_31(VectorField& field, State31& state, double longest, double share);

}  // namespace gainsmith::simulate
