// Numbers in JSON that are read back to the same bits, whatever they are.
#pragma once

#include "io/json/json_reader.h"
#include "io/json/json_text.h"

namespace gainsmith::app {

/// JSON has no infinity, no NaN and no sign of zero: they are texts.
io::Json bits(double value);
double from_bits(const io::JsonReader& reader);

}  // namespace gainsmith::app
