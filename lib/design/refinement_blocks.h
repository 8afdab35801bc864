// The inequalities of a design at one value of its scalars, as the smooth program of
// joint_refinement.h has them.
#pragma once

#include <string>
#include <vector>

#include "lmi/formulation.h"
#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::design {

/// The design changes its shape with the scalars: no smooth program.
struct NotSmooth {
  std::string cause;
};

/// The affine blocks at one value of the scalars, shifts taken off, with the figure's coefficients.
/// `unknowns` counts the scalars of the gain bounds too.
struct SmoothBlocks {
  int unknowns = 0;
  std::vector<lmi::Block> list;
  std::vector<double> shifts;  ///< shift_k of joint_refinement.h, one a block
  std::vector<double> cost;    ///< of the unknowns; empty when the figure is a scalar
  double constant = 0;
  lmi::GainBounds bounds;
  lmi::Unknowns layout;  ///< where each unknown is among them
};

/// InputError as for lmi::compile().
SmoothBlocks smooth_blocks(const model::Instance& instance);

/// The unknowns of the gains as one vector, and the scalars of the gain bounds at their largest.
/// NotSmooth when an unknown has no value.
std::vector<double> packed(const SmoothBlocks& blocks, const model::Gains& gains);

}  // namespace gainsmith::design
