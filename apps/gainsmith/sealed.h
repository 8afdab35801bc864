// Documents that programs hand to each other: whole, or refused.
#pragma once

#include <string>

#include "io/json/json_text.h"

namespace gainsmith::app {

/// The text of a document with one key more, the sha256 of what it says.
std::string sealed(io::Json document);

/// The document of such a text, without that key. InputError for one that was cut or changed;
/// `what` says what was expected: "a part of a campaign".
io::Json unsealed(const std::string& text, const std::string& file, const std::string& what);

}  // namespace gainsmith::app
