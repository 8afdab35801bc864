// The gain file: one JSON document with all that a synthesis found and all that it was made from.
//
// It holds verdict, gains, unknowns, margins and certificates, the texts of method and problem with
// their SHA-256, and the matrices of other files. So it can be checked, simulated and exported
// without the files that it came from (docs/gain-file.md). Numbers have their decimals: a proof is
// about the decimals in the file, not about the doubles nearest to them.
#pragma once

#include <string>

#include "io/json/json_text.h"
#include "io/yaml/problem_yaml.h"
#include "model/gains.h"

namespace gainsmith::io {

/// The document. Timings are in a block of their own, last. A decimal with 17 digits reads back
/// to the same double, so writing, reading and writing again gives the same bytes. Matrices and
/// searched scalars that were read with other decimals are written with these again.
Json to_json(const model::Gains& gains);

/// The text of a gain file.
std::string gains_text(const model::Gains& gains);

/// Reads a gain file. InputError with the place, or the path of the key, when it is truncated,
/// lacks a key, holds an unknown one or a value of the wrong kind, when its status or cause differs
/// from its solver's, or when its statement does not match its hash. The decimals of its matrices
/// and searched scalars are kept (model::decimals_of).
model::Gains parse_gains(const std::string& text, const std::string& file);

/// The problem that a gain file states; the method is the text in the file, whatever the program's
/// own method of that name says today.
model::Problem stated_problem(const model::Gains& gains, const std::string& file);

/// A matrix as a list of rows.
Json matrix_json(const numbers::Matrix& matrix);

}  // namespace gainsmith::io
