#define GAINSMITH_VARIANT variant_v3
#define GAINSMITH_VARIANT_NAME "v3"
#include "lanes/steps_rules.h"
