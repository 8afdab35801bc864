// The operations over lanes for x86-64-v2: vectors of 2 numbers.
#define GAINSMITH_VARIANT variant_v2
#define GAINSMITH_VARIANT_NAME "v2"
#include "lanes/steps_rules.h"
