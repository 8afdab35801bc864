// Whether a flow goes on along the switching surface of a switch, to which both branches lead back.
//
//   at once       8 switches within 1e-9 of the horizon
//   within noise  100 switches of one branch in a row, without a jump between them, between which
//                 what it branches on never leaves the error of the integration: of x' = -sign(x)
//                 sqrt(abs(x)) after it has come to 0
//
// A run has one branch at a time. It does not follow the sliding mode of Filippov 1988, a mean of
// both branches along D = 0, but ends with the place of the switch.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "simulate/event_watch.h"
#include "simulate/flow.h"

namespace gainsmith::simulate {

class SlidingDetector {
 public:
  /// The system and the watch must outlive it.
  SlidingDetector(const hybrid::System& system, EventWatch& watch, const Accuracy& accuracy,
                  double horizon);

  /// A jump begins another row.
  void jumped() { row_ = 0; }
  /// A step has led to these values.
  void moved(const Eigen::VectorXd& values);
  /// RunEnd where that slides.
  void switched(std::size_t branch, double t, const Eigen::VectorXd& values);

 private:
  /// |D| since the last switch <= absolute + relative * terms.
  bool is_noise(const Eigen::VectorXd& values);
  /// RunEnd that names the switch and its place.
  [[noreturn]] void end(std::size_t branch) const;

  const hybrid::System* system_;
  EventWatch* watch_;
  Accuracy accuracy_;
  double horizon_;
  std::vector<double> times_;  ///< of the last switches
  std::size_t branch_ = 0;     ///< of the row
  std::size_t row_ = 0;        ///< switches in it
  Eigen::VectorXd swing_;      ///< since the last of them: |D| at its largest
};

}  // namespace gainsmith::simulate
