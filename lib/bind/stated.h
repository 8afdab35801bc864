// The texts of a gain file, bound (model/stated.h).
//
// A gain file has matrices of unknowns and gains, functions with their coefficients, formulas of
// gains, parameters, and bases that were chosen.
#pragma once

#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"
#include "model/run_texts.h"

namespace gainsmith::bind {

/// InputError for a matrix of another shape or not finite, when the file defines what is no unknown
/// function, lacks its coefficients, or holds a text that does not fit.
model::Stated state(const model::Instance& instance, const model::Gains& gains);

/// What runs read; InputError for the same, and as model::run_texts.
model::RunTexts run_texts(const model::Instance& instance, const model::Gains& gains);

/// What the problem's own method declares and no text reads, a sentence each.
const std::vector<std::string>& unread_names(const model::Design& design);

}  // namespace gainsmith::bind
