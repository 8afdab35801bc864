// The operations over lanes for x86-64-v4: vectors of 8 numbers, with fused products.
#define GAINSMITH_VARIANT variant_v4
#define GAINSMITH_VARIANT_NAME "v4"
#include "lanes/steps_rules.h"
