// All programs of dynamics that read what moves.
#pragma once

#include <functional>

#include "model/dynamics.h"

namespace gainsmith::model {

void for_each_program(const Dynamics& dynamics,
                      const std::function<void(const expr::Program&)>& visit);

}  // namespace gainsmith::model
