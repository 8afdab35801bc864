// Internal to io: the `expect:` block of a problem.
#pragma once

#include "io/yaml.h"

namespace gainsmith::io {

model::Expectation expectation_from(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
