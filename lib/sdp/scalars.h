// The number types that the solver is built for.
#pragma once

// Expands DO(T) for each of them; used at the end of a source for its explicit instantiations.
#define GAINSMITH_FOR_EACH_SCALAR(DO) DO(double)
