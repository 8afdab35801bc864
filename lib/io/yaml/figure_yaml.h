// Internal to io: figures of runs, expected or to be compared.
#pragma once

#include <vector>

#include "io/yaml/yaml.h"
#include "model/figure.h"

namespace gainsmith::io {

/// The list under `compare`.
std::vector<model::FigureText> figures(const YamlFile& file, const YamlItem& item);

/// A single figure, such as `search.minimize`.
model::FigureText figure_of(const YamlFile& file, const YamlItem& item);

/// The list under `expect.run`.
std::vector<model::ExpectedFigureText> expected_figures(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
