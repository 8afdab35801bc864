// The statement of a gain file: the texts that the gains answer, settings from outside, other files,
// and the hash of all.
#pragma once

#include "io/json/json_reader.h"
#include "model/gains.h"

namespace gainsmith::io {

Json statement_json(const model::Statement& statement);
/// InputError where texts and files do not have the hash: the file was edited.
model::Statement statement_of(const JsonReader& reader);

}  // namespace gainsmith::io
