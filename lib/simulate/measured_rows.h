// The rows of measured data (model/measured.h) along one run.
//
// At the time of a row the quantity has the first value there as long as events are asked;
// the flow goes on with the last one, and along the line to the next row.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "hybrid/system.h"

namespace gainsmith::simulate {

class MeasuredRows {
 public:
  explicit MeasuredRows(const hybrid::System& system);

  /// The values at t = 0.
  void begin(Eigen::VectorXd& values);
  /// The time of the next row; infinity when there is none.
  double next() const;
  /// Gives the values that events at t see; whether there are rows at t.
  bool arrive(double t, Eigen::VectorXd& values) const;
  /// Gives the values and rates with which the flow goes on from t; whether there were rows at t.
  bool leave(double t, Eigen::VectorXd& values);

 private:
  /// One series and where its values are in the vector of the run.
  struct Quantity {
    const model::Dynamics::Measured* measured;
    Eigen::Index value;                ///< its first element among the values
    std::optional<Eigen::Index> rate;  ///< and that of its rate
    std::size_t row = 0;               ///< the next one
  };
  static bool is_due(const Quantity& quantity, double t);

  std::vector<Quantity> quantities_;
};

}  // namespace gainsmith::simulate
