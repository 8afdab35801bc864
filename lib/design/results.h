// What an expression about a result may use, with its values.
#pragma once

#include <optional>

#include "model/gains.h"
#include "model/instance.h"
#include "model/stated.h"

namespace gainsmith::design {

/// Data, parameters, unknowns, gains and `objective` of a result.
class Results {
 public:
  Results(const model::Instance& instance, const model::Gains& gains);

  /// The value; none when the formula uses something that has none, such as a gain of a problem
  /// without solution.
  std::optional<numbers::Matrix> value(const model::Formula& formula) const {
    return stated_.value(formula.program);
  }

 private:
  model::Stated stated_;
};

}  // namespace gainsmith::design
