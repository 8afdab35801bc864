// Measured data in a run, read again from their rows.
//
// Between two rows the value is held or is on the line through them, as the text says.
#pragma once

#include "hybrid/trajectory.h"
#include "judge/faults.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// No row lies inside of the step, and within it quantities and rates are those of their files.
void check_measured(const Texts& texts, std::size_t part, const hybrid::DenseStep& step,
                    Faults& faults);
/// At an instant: one of the rows there, or the course between two.
void check_measured(const Texts& texts, std::size_t part, double t, const Eigen::VectorXd& x,
                    Faults& faults);

}  // namespace gainsmith::judge
