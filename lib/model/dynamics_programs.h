// All programs of dynamics that read what moves.
#pragma once

#include <functional>

#include "model/dynamics.h"

namespace gainsmith::model {

void for_each_program(const Dynamics& dynamics,
                      const std::function<void(const expr::Program&)>& visit);

/// The same but for signals, with their places: what a run evaluates.
void for_each_run_program(Dynamics& dynamics,
                          const std::function<void(expr::Program&, const Place&)>& visit);

}  // namespace gainsmith::model
