// Internal to io: the choices for the synthesis.
#pragma once

#include <cstdint>
#include <optional>

#include "io/yaml/yaml.h"
#include "model/words.h"

namespace gainsmith::io {

/// "synthesis: {margin: 1e-6, gain_bound: 10, forall: hull}".
model::SynthesisOptions synthesis(const YamlFile& file, const std::optional<YamlItem>& item);

/// "margin: 1e-6".
void set_margin(const YamlFile& file, const YamlItem& item, model::SynthesisOptions& options);

/// "gain_bound: 10", "gain_bound: {L: 0.01, F: 10}" or "gain_bound: none".
void set_gain_bound(const YamlFile& file, const YamlItem& item, model::SynthesisOptions& options);

/// A whole number from `least` to 1e15.
std::uint64_t whole(const YamlFile& file, const YamlItem& item, double least);

}  // namespace gainsmith::io
