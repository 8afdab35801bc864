// Part of the program that is linked with NLopt and Ipopt.
#include "gainsmith/optimizers.h"
#include "search/ipopt.h"
#include "search/nlopt.h"

namespace gainsmith::app {

const search::Optimizers* linked_optimizers() {
  static const search::Optimizers kLinked{search::nlopt_search(), search::ipopt_solver()};
  return &kLinked;
}

}  // namespace gainsmith::app
