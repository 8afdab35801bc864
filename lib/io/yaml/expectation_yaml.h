// Internal to io: the `expect:` block of a problem.
#pragma once

#include "io/yaml/yaml.h"

namespace gainsmith::io {

/// The words, values and figures that `expect:` states. InputError for an unknown word or key.
model::Expectation expectation_from(const YamlFile& file, const YamlItem& item);

/// A tolerance, which may be left out. InputError when it is negative.
std::optional<double> tolerance(const YamlFile& file, const std::optional<YamlItem>& item);

}  // namespace gainsmith::io
