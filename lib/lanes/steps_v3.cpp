// The operations over lanes for x86-64-v3: vectors of 4 numbers, with fused products.
#define GAINSMITH_VARIANT variant_v3
#define GAINSMITH_VARIANT_NAME "v3"
#include "lanes/steps_rules.h"
