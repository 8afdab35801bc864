// The exponentials of exact flows (simulate/exact_flow.h). They depend on what is frozen, on the
// branches that are taken and on values that rest alone. So all flows and runs of one simulator
// share them.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "base/eigen_scalars.h"
#include "numbers/matrix.h"

namespace gainsmith::ode {

/// The maps z(t + h) = exp(h G) z(t) of z' = G z over the parts of the steps of one generator G.
/// Steps have the lengths shortest * 2^level; a level follows from the one before by squaring.
struct ExponentialTable {
  /// 31 digits: squaring multiplies the rounding of a short step by |G| times the length. A run
  /// that is repeated with smaller errors has the same maps, and does not show it.
  using WideMatrix = numbers::MatrixOf<DoubleDouble>;

  struct Level {
    double length = 0;
    std::vector<WideMatrix> wide;  ///< to each point of the series
    /// `wide`, rounded to double.
    std::vector<numbers::Matrix> maps;
  };

  numbers::Matrix generator;
  std::vector<WideMatrix> terms;  ///< (G length)^k/k! of level 0
  double shortest = 0;            ///< its length
  int top = 0;                    ///< the highest level
  std::map<int, Level> levels;
};

class ExponentialTables {
 public:
  /// The table of a key; fresh where it is not known. Beyond a number of tables all are forgotten,
  /// as for noise that never comes back; a shared pointer keeps its own.
  std::shared_ptr<ExponentialTable>& at(const std::vector<double>& key) {
    if (tables_.size() >= capacity && !tables_.contains(key)) tables_.clear();
    return tables_[key];
  }

 private:
  static constexpr std::size_t capacity = 256;
  std::map<std::vector<double>, std::shared_ptr<ExponentialTable>> tables_;
};

}  // namespace gainsmith::ode
