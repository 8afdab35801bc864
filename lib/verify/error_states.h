// The same dynamics with errors of observers as states.
//
//   d = a - b in place of b,   d' = f_a - f_b,   d+ = a+ - b+,   b = a - d elsewhere
//
// for states a, b whose difference stands in a claim. It is done where d moves by itself: where a
// drops out of d' and of all d+ (bounded/differences.h). Then rounding of a, which may grow, is no
// error of d.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bounded/differences.h"
#include "hybrid/scenario.h"
#include "hybrid/system.h"

namespace gainsmith::verify {

class ErrorStates {
 public:
  /// None without such a difference. `functions`: of the claims, without calls.
  static std::optional<ErrorStates> of(const hybrid::System& system,
                                       const std::vector<expr::Program>& functions);

  /// b keeps its place; its name is that of the difference.
  const model::Dynamics& dynamics() const { return dynamics_; }
  /// Starts are drawn as they were; then d is a - b.
  void rewrite(hybrid::Scenario& scenario) const;
  /// A program without calls.
  expr::Program operator()(const expr::Program& program);

 private:
  ErrorStates(const hybrid::System& system, std::vector<bounded::StateDifference> differences);

  void find_flows();
  void find_jumps();
  model::Dynamics::Assignment& map_of(std::size_t event, std::size_t variable,
                                      const model::Dynamics::Assignment& like);
  /// The first difference that does not move by itself.
  std::optional<std::size_t> first_bound() const;

  struct Place {
    std::size_t plus = 0, minus = 0;  ///< of a and b among the variables
  };
  std::vector<bounded::StateDifference> differences_;
  std::vector<Place> places_;
  bounded::ErrorRewriting rewriting_;
  model::Dynamics dynamics_;
};

}  // namespace gainsmith::verify
