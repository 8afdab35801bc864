// The maps of the jumps of a System.
//
// x+ = g(x) component by component: each reaction starts from x before the jump, so that the order
// of components does not matter. Maps of one reaction follow each other on its own states.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hybrid/event_functions.h"
#include "simulate/last_places.h"
#include "simulate/state_31.h"

namespace gainsmith::simulate {

/// All maps are compiled once. The system must outlive it.
class JumpMaps {
 public:
  explicit JumpMaps(const hybrid::System& system);

  /// The values after the event's reactions, of the plant alone when it is lost. Each component
  /// sees its own states as its map before left them, everything else as in `before`. Of the run's
  /// own variables j, count(event) and passes(event) are new: passes of the loops of the jump
  /// together. RunEnd for a loop whose `until` does not become true; EvaluationError where a map
  /// has no value; InputError for a mode that is no whole number and a symmetric state that is not.
  /// `moved`: by which results of arithmetic are moved, in a perturbed run. `state`: the same
  /// values in 31 digits, in which the maps are evaluated then.
  Eigen::VectorXd operator()(std::size_t event, bool lost, const Eigen::VectorXd& before,
                             const LastPlaces* moved = nullptr, const State31* state = nullptr);
  /// The values after the last jump in 31 digits.
  const Values31& in_31_digits() const { return after_31_; }
  /// Of the last jump of a perturbed run, by element of the values: hybrid::JumpPoint::terms.
  const Eigen::VectorXd& terms() const { return terms_; }

 private:
  struct MapEntry {
    std::size_t variable = 0;
    const expr::Program* program = nullptr;
    hybrid::SystemFunction value;
    std::optional<Function31> value_31;  ///< made when it is asked for
    Place place;
    std::unique_ptr<const expr::Program> terms_program;
    std::optional<hybrid::SystemFunction> terms;  ///< none: nothing is computed
    std::vector<double> constants;                ///< of the text, and their opposites
  };
  struct Map {
    std::vector<MapEntry> entries;
    std::optional<hybrid::EventCondition> until;
  };
  using Maps = std::vector<Map>;  ///< of one reaction

  /// All maps of one reaction, from `before`; writes the states that they set to `after`. The
  /// passes of its loops.
  std::int64_t react(std::size_t reaction, const Eigen::VectorXd& before, Eigen::VectorXd& after);
  /// Applies the map until its condition is true, `most` times at most; how often.
  std::int64_t repeat(const model::Dynamics::Pass& pass, std::int64_t most, Map& map,
                      Eigen::VectorXd& own);
  void apply(Map& map, Eigen::VectorXd& own);
  /// Moves what arithmetic has computed by +-8 u of its terms, and notes the terms.
  void move(MapEntry& entry, const Eigen::VectorXd& own, std::size_t result);
  /// A mode is a whole number. A symmetric state is, up to kMeantEqual; then (P + P')/2.
  void check(const MapEntry& entry, const Eigen::VectorXd& own, numbers::Matrix& value) const;
  void count(std::size_t event, std::int64_t passes, Eigen::VectorXd& after);

  const hybrid::System* system_;
  std::vector<Maps> maps_;                ///< by reaction
  std::vector<numbers::Matrix> results_;  ///< of one map
  std::vector<Matrix31> results_31_;
  const State31* state_ = nullptr;
  Values31 own_31_, after_31_;
  const LastPlaces* moved_ = nullptr;
  Eigen::VectorXd terms_;
};

}  // namespace gainsmith::simulate
