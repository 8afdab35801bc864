// JSON schemas of the files, made from the tables of their keys: editors complete and check files
// by them.
#pragma once

#include "io/json/json_text.h"

namespace gainsmith::io {

/// The schema (draft 7) of problem files. YAML is meant as its version 1.2 reads it: 3 is a number,
/// yes a text. It accepts every file that the reader accepts, and refuses unknown, missing and
/// contradicting keys and values of the wrong kind; formulas are texts to it.
Json problem_schema();

/// The same of method files.
Json method_schema();

/// The same of gain files.
Json gain_file_schema();

}  // namespace gainsmith::io
