// What dynamics say that is allowed and perhaps not meant, a sentence each, with its mend:
//
//   an observer whose states never change, or observers of which none reads the plant
//   an event that may be lost, where no observer has a map
//   noise without `new at` that samples or outputs read: one value for the whole run, a bias
//   noise that changes more slowly than the samples that read it
//   two outputs, or two elements of one, with the same scalar noise
//   a claim that a value shrinks to more than it is
//   uncertain data that the plant does not read or an observer knows, or without a range around
//   them
#pragma once

#include <string>
#include <vector>

#include "model/design.h"
#include "numbers/types/real.h"

namespace gainsmith::hybrid {

/// `constants`: of data and parameters.
std::vector<std::string> doubts_about(const model::Dynamics& dynamics,
                                      const std::vector<model::Design::Claim>& claims,
                                      const numbers::Values& constants);

}  // namespace gainsmith::hybrid
