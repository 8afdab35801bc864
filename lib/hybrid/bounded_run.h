// One run in the coordinates of a judgement, in double or in 31 digits, with a bound of its error.
//
// The run is that of its draws: first state, intervals and horizon are the doubles that were drawn,
// and its maps are those of the decimals. With e = true x - x, a step x+ = fl(E x + f) has
//
//   e+ = E e + d,   |d_i| <= delta_i = (n + 4) u (|E| |x| + |f|)_i + what the error of E adds
//
// Bounds element by element would grow with the powers of |E|, which says nothing of E. Instead
//
//   Y+ = E Y E' + n diag(delta)^2,  m the number of deltas:
//   |c' e|^2 <= (sum of |c' Phi_i| delta_i)^2 <= m c' Y c   for every c (Cauchy and Schwarz)
//
// so errors turn and die down as the run itself does, and |e_i| <= sqrt(m Y_ii). Y is kept as
// G G' + Z: Z is what came since the last jump, and each jump takes it into G, by the factorisation
// [G, sqrt(n diag Z)]' = Q R. Both are computed in double. The rounding of E G is a delta like the
// others, eps |E| |G|, so G may fall over hundreds of decades; that of E Z E', at most eps g_i g_j
// with g = |E| sqrt(diag Z), is covered by n eps g^2 on the diagonal. A row of the identity adds
// nothing, so what stays as it is has no error of its own, and 0 that is exact stays so.
//
// A jump that is affine in the states with coefficients that depend on clocks (F(s)) is a step
// whose E has a bound of its own. An entry of any other kind is evaluated over balls (ball.h): its
// row of E is 0 and delta is the radius.
#pragma once

#include <Eigen/QR>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hybrid/arc.h"
#include "hybrid/simulate.h"
#include "hybrid/step_maps.h"

namespace gainsmith::hybrid {

template <class Scalar>
using BallsOf = std::map<std::string, Ball<Scalar>, std::less<>>;

/// A program over balls as a function of (x, tau). Everything given must outlive it.
template <class Scalar>
class BallFunction {
 public:
  BallFunction(const expr::Program& program, const StateLayout& layout,
               const BallsOf<Scalar>& constants);
  BallFunction(BallFunction&&) = default;
  BallFunction& operator=(BallFunction&&) = default;

  const Ball<Scalar>& operator()(const Eigen::Ref<const ColumnOf<Scalar>>& x,
                                 const Eigen::Ref<const Eigen::VectorXd>& r, const Scalar& tau,
                                 double tau_bound);

 private:
  std::vector<Slot> slots_;  ///< those that the program uses
  std::vector<Ball<Scalar>> moving_;
  expr::Evaluator<BallAlgebra<Scalar>> evaluator_;
};

/// The samples of a run in these coordinates, those of the Arc of the same run.
template <class Scalar>
struct Track {
  Eigen::Index size = 0;
  std::vector<double> t;
  std::vector<std::int64_t> j;
  std::vector<Scalar> timer;
  std::vector<double> timer_bound;
  std::vector<Move> moves;
  std::vector<Scalar> stacked;
  std::vector<double> bounds;
  Termination termination = Termination::horizon;
  std::string message;

  void clear() {
    for (auto* list : {&t, &timer_bound, &bounds}) list->clear();
    timer.clear();
    j.clear();
    moves.clear();
    stacked.clear();
    termination = Termination::horizon;
    message.clear();
  }
  std::size_t samples() const { return t.size(); }
  Eigen::Map<const ColumnOf<Scalar>> state(std::size_t sample) const {
    return {stacked.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
  Eigen::Map<const Eigen::VectorXd> bound(std::size_t sample) const {
    return {bounds.data() + static_cast<Eigen::Index>(sample) * size, size};
  }
};

/// What the runs of one Scalar share.
template <class Scalar>
struct BoundedSystem {
  BoundedSystem(const Coordinates& coordinates, const ExactSteps& exact,
                const std::vector<numbers::MatrixOf<Decimal100>>& forms);

  const Coordinates* coordinates;
  BallsOf<Scalar> constants;
  StepMaps<Scalar> steps;
  std::optional<BoundedMap<Scalar>> jump;  ///< when it is affine with constant coefficients
  std::vector<bool> linear_jump;           ///< of each coordinate: affine, with clocks as numbers
};

/// Simulates run after run; one for each thread. All arguments must outlive it.
template <class Scalar>
class BoundedSimulator {
 public:
  BoundedSimulator(const System& system, const Scenario& scenario, const FlowSteps& steps,
                   const BoundedSystem<Scalar>& bounded);

  /// The run that Simulator makes of the same seed and number. It ends as diverged when a
  /// coordinate leaves [-1e150, 1e150]; what is no coordinate may grow.
  const Track<Scalar>& run(std::uint64_t seed, std::uint64_t run);

 private:
  void start(std::uint64_t run, RandomStream& random);
  void flow(double interval);
  void jump(double reset_value);
  void linear_entry(std::size_t coordinate);
  void ball_entry(std::size_t coordinate);
  void rest(double length);
  int taylor_sum(double length);
  double taylor_map(double length);
  void step(const BoundedMap<Scalar>& map);
  /// G and Z after a step with the errors delta_, E and |E|; `slack`: relative errors of E besides
  /// its rounding.
  void propagate(const numbers::Matrix& E, const numbers::Matrix& sizes, double slack);
  void set_bounds();
  void rescale(double largest);
  /// Takes Z into G.
  void gather();
  void append(double t, std::int64_t j, const Scalar& timer, double timer_bound);

  const System* system_;
  const Scenario* scenario_;
  const FlowSteps* cutting_;
  const BoundedSystem<Scalar>* bounded_;
  Starts starts_;
  std::vector<BallFunction<Scalar>> first_;  ///< of the expressions, over the system's states
  std::vector<BallFunction<Scalar>> begin_;  ///< of the coordinates, over the system's states
  std::vector<std::unique_ptr<BallFunction<Scalar>>> after_;
  std::vector<StartRule> const* rules_;
  std::vector<FlowStep> cuts_;
  Track<Scalar> track_;
  ColumnOf<Scalar> x_, next_, term_, other_term_;
  Eigen::VectorXd size_, other_size_;
  numbers::Matrix E_, E_sizes_;  ///< of a rest
  double tail_ = 0;              ///< what the Taylor sum leaves, relative
  Eigen::VectorXd r_, delta_;
  numbers::Matrix G_, Z_, product_;
  Eigen::VectorXd norm_, root_;  ///< of the rows of G_; of the diagonal of Z_
  double scale_ = 1;             ///< G is scale G_, Z is scale^2 Z_
  double steps_ = 0;
  numbers::Matrix stacked_;
  Eigen::HouseholderQR<numbers::Matrix> factored_;
  numbers::MatrixOf<Scalar> J_;
  numbers::Matrix J_rounded_, J_sizes_;
};

}  // namespace gainsmith::hybrid
