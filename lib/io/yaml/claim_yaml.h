// Internal to io: "claims" of a method.
#pragma once

#include "io/yaml/yaml.h"
#include "model/method.h"

namespace gainsmith::io {

/// "lyapunov: {nonincreasing: V}", "small: {below: norm(e), bound: 0.1, after: 5}".
model::Claim claim(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
