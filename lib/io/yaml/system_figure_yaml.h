// Internal to io: an entry of `figures`.
#pragma once

#include "io/yaml/yaml.h"
#include "model/system_figure.h"

namespace gainsmith::io {

/// "loop: {bode: P*K, over: [0.1, 100], title: ...}". InputError for no or two kinds of picture.
model::SystemFigureText system_figure(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
