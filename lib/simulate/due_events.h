// Which event of a System is due (simulator.h says when).
//
// One mark an event holds what its past says: whether an occurrence is spent, and the last certain
// sign of e. A crossing is a change of that sign in the wanted direction. Rounding that leads back
// over the root is none.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "hybrid/scenario.h"
#include "simulate/event_watch.h"
#include "simulate/vector_field.h"

namespace gainsmith::simulate {

class DueEvents {
 public:
  /// What is known of an event besides its text.
  struct Mark {
    bool spent = false;  ///< `when`: not due until its condition has been false
    /// The last of e that was not 0; 0 where the start or a jump led e to 0, but for rounding.
    int sign = 0;
    bool crossed = false;  ///< in the direction of the event, and due
    /// Since when it is, where e has not left its rounding yet; otherwise no time.
    double since = -std::numeric_limits<double>::infinity();
    int pending = 0;  ///< a sign against that direction, which is rounding if something is due
  };

  DueEvents(const hybrid::System& system, EventWatch& watch, hybrid::EventClocks clocks,
            double horizon);

  /// At the start of a run.
  void begin(const Eigen::VectorXd& values, VectorField& field);
  /// The first that is due. Asking changes marks: a crossing that was found remains due.
  std::optional<std::size_t> first(const Eigen::VectorXd& values, double t);
  /// The occurrence at t is over.
  void spend(std::size_t event, double t, VectorField& field);
  /// After its jump: what its own map does to e is no crossing.
  void jumped(std::size_t event, const Eigen::VectorXd& before, const Eigen::VectorXd& values);

  hybrid::EventClocks& clocks() { return clocks_; }
  /// To search ahead and to come back.
  std::vector<Mark> marks() const { return marks_; }
  void set_marks(const std::vector<Mark>& marks) { marks_ = marks; }

 private:
  /// Updates the mark of the event; clocks may be early by rounding at the horizon.
  bool is_due(std::size_t event, const Eigen::VectorXd& values, double t);
  /// 1, 0 or -1.
  int sign_of(std::size_t event, const Eigen::VectorXd& values);
  /// Sets `crossed` where the sign of e has changed for sure in the direction of the event.
  void note_sign(std::size_t event, const Eigen::VectorXd& values, double t);

  const hybrid::System* system_;
  EventWatch* watch_;
  hybrid::EventClocks clocks_;
  double horizon_;
  std::vector<Mark> marks_;
};

}  // namespace gainsmith::simulate
