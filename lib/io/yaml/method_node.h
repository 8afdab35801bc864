// Internal to io: a method as a mapping inside a file (a whole method file, or `method:` of a
// problem).
#pragma once

#include <string>

#include "io/yaml/yaml.h"
#include "model/method.h"

namespace gainsmith::io {

/// `problem`: the name of the problem that contains the method, which is its own name where it
/// gives none; empty for a method file, which needs one. One that states neither inequalities nor
/// dynamics nor a report is an error, unless it may.
model::Method method_from(const YamlFile& file, const YAML::Node& node, const std::string& problem,
                          bool may_state_nothing = false);

/// The reason of "no campaign", which is not empty.
std::string reason(const YamlFile& file, const YamlItem& item);

/// "tau in [a, b]", "k in {a, b, c}", "h in v" with a vector v, or "A in conv{A1, A2}".
model::Forall parse_forall(const expr::Text& text);

/// Splits "a, b, c" at commas outside brackets and parses the parts.
std::vector<expr::Expression> parse_list(const expr::Text& text);

}  // namespace gainsmith::io
