#include "simulate/flow.h"

#include <algorithm>

#include "ode/tolerances.h"
#include "simulate/exact_flow.h"
#include "simulate/integrated_flow.h"

namespace gainsmith::simulate {

Accuracy Accuracy::times(double factor) const {
  return {std::max(relative * factor, ode::kFinest), absolute * factor, absolute_of * factor,
          factor < 1 ? ode::kShorter * longest : longest, in_31_digits};
}

std::unique_ptr<Flow> make_flow(VectorField& field, const Accuracy& accuracy, double longest,
                                const LastPlaces* moved) {
  return field.system().affine ? exact_flow(field, longest, moved)
                               : integrated_flow(field, accuracy, longest);
}

}  // namespace gainsmith::simulate
