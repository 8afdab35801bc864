// A design that is bound with other values.
//
// A scan or a search changes scalars many times. Programs are kept as long as shapes and all that
// binding took from values stay, so that texts are bound anew only where they must.
#pragma once

#include "model/instance.h"

namespace gainsmith::bind {

/// Values for the data and parameters of a design. An overridden scalar has that value whatever the
/// problem gives; defaults that use it follow. The design of the instance is the one given, or one
/// bound anew when an override changes a dimension (the degree of an unknown function, a rank).
/// InputError for a datum without a value, one that is not symmetric or diagonal where it must be,
/// for an assumption that fails (at the place of the datum), and for an override that names no
/// scalar datum or parameter or is not finite.
model::Instance evaluate(const model::DesignPtr& design, const model::Overrides& overrides = {});

}  // namespace gainsmith::bind
