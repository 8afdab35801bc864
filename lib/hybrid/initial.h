// Where runs start.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "hybrid/system.h"

namespace gainsmith::hybrid {

/// How one state starts, with its numbers.
struct StartRule {
  model::StartKind kind = model::StartKind::box;
  /// box: low, high; list: the elements; ellipsoid: its center and the map M of draw_ellipsoid.
  std::vector<numbers::Matrix> values;
  expr::Program program;  ///< expression
  Place place;
};

/// Replaces center, matrix Q and level r of an ellipsoid by its center and M = sqrt(r) inv(L)',
/// with Q = L L': {c + M b: |b| <= 1} = {x: (x - c)' Q (x - c) <= r}. InputError when Q is not
/// symmetric and positive definite, or r is negative. `state`: the name, for messages.
void read_ellipsoid(StartRule& rule, const std::string& state);

/// A point c + M b, with b uniform in the unit ball: b = u^(1/n) z/|z|, z normal. 2n + 1 draws: two
/// an element of z, sqrt(-2 log(1 - u)) cos(2 pi v), and u.
Eigen::VectorXd draw_ellipsoid(const StartRule& rule, RandomStream& random);

/// One rule a state, in the order of the layout; a state that the campaign does not name starts
/// where the method says, otherwise in the box [-1, 1]. InputError for a symbol without a value, an
/// empty box (low > high), and an expression that uses the timer or a state that is not declared
/// before its own.
std::vector<StartRule> make_start_rules(const model::Design& design, const System& system);

/// Draws initial states; one for each thread. The rules and the system must outlive it.
class Starts {
 public:
  Starts(const std::vector<StartRule>& rules, const System& system);

  /// The initial state of a run: state by state, a box taking one draw an element, column by
  /// column, an ellipsoid those of draw_ellipsoid.
  Eigen::VectorXd operator()(std::uint64_t run, RandomStream& random);

 private:
  const std::vector<StartRule>* rules_;
  const StateLayout* layout_;
  std::vector<PointFunction> expressions_;  ///< of the rules that are expressions, in order
};

}  // namespace gainsmith::hybrid
