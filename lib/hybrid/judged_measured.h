// Internal to hybrid: measured data in a run, read again from their rows.
#pragma once

#include "hybrid/judged_faults.h"
#include "hybrid/judged_texts.h"
#include "hybrid/trajectory.h"

namespace gainsmith::hybrid::judging {

/// No row lies inside of the step, and within it quantities and rates are those of their files.
void check_measured(const JudgedTexts& texts, std::size_t part, const DenseStep& step,
                    Faults& faults);
/// At an instant: one of the rows there, or the course between two.
void check_measured(const JudgedTexts& texts, std::size_t part, double t, const Eigen::VectorXd& x,
                    Faults& faults);

}  // namespace gainsmith::hybrid::judging
