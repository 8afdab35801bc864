// Searches over scalars as text for people.
#pragma once

#include <string>

#include "model/gains.h"

namespace gainsmith::app {

/// What a search found: the value, the proved end beyond it, what is undecided, breaks. Empty when
/// nothing was searched.
std::string search_text(const model::Gains& gains);

}  // namespace gainsmith::app
