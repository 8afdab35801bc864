#define GAINSMITH_VARIANT variant_v4
#define GAINSMITH_VARIANT_NAME "v4"
#include "lanes/steps_rules.h"
