// Where runs start.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "hybrid/system.h"

namespace gainsmith::hybrid {

/// How one state starts, with its numbers.
struct StartRule {
  model::StartKind kind = model::StartKind::box;
  std::vector<numbers::Matrix> values;  ///< box: low, high; list: the elements
  expr::Program program;                ///< expression
  Place place;
};

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
  /// column.
  Eigen::VectorXd operator()(std::uint64_t run, RandomStream& random);

 private:
  const std::vector<StartRule>* rules_;
  const StateLayout* layout_;
  std::vector<PointFunction> expressions_;  ///< of the rules that are expressions, in order
};

}  // namespace gainsmith::hybrid
