// Internal to io: the `search:` and `negotiable:` blocks of a problem, and ranges of scalars.
#pragma once

#include "io/yaml/yaml.h"
#include "model/problem.h"

namespace gainsmith::io {

/// "T2: [0.5, 1.1]": the ends are expressions.
model::ScalarRange scalar_range(const YamlFile& file, const YamlItem& item);

/// A mapping of such ranges. InputError for a name that is no scalar datum or parameter of the
/// method.
std::vector<model::ScalarRange> scalar_ranges(const YamlFile& file,
                                              const std::optional<YamlItem>& item,
                                              const std::string& what, const model::Method& method);

/// `search:`. InputError unless it says what is searched.
model::Search search_from(const YamlFile& file, const YamlItem& item, const model::Method& method);

}  // namespace gainsmith::io
