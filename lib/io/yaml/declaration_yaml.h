// Internal to io: what methods and components declare, and the keys that many mappings have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/yaml/yaml.h"
#include "model/declaration.h"

namespace gainsmith::io {

/// Nothing of an absent item.
std::optional<expr::Expression> optional_expression(const YamlFile& file,
                                                    const std::optional<YamlItem>& item);
/// Empty where the item is absent.
std::string optional_string(const YamlFile& file, const std::optional<YamlItem>& item);

/// The texts of a key that takes one or a list of them.
std::vector<expr::Text> texts_of(const YamlFile& file, const YamlItem& item);

/// "for: i in 1..N" or "for: [i in 1..N, j in 1..M]".
std::vector<expr::Index> indices(const YamlFile& file, const std::optional<YamlItem>& item);

/// "of: {x: n, u: 2}".
std::vector<model::Argument> arguments_of(const YamlFile& file, const YamlItem& of);

/// "A: n x n" or "A: {shape: n x n, default: ..., help: ...}"; `fallback` is the key of the value
/// without a given one: "default" of a datum, "start" of a state.
model::Declaration declaration(const YamlFile& file, const YamlItem& item, const char* fallback);

}  // namespace gainsmith::io
