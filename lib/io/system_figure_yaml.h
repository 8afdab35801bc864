// Internal to io: an entry of `figures`.
#pragma once

#include "io/yaml.h"
#include "model/system_figure.h"

namespace gainsmith::io {

model::SystemFigureText system_figure(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
