// The identities of sums of squares in gain files: of an inequality M(x) >= 0
//   row' M(x) row = sum over squares of g_k(x) z' Q z + sum over free terms of h_k(x) t         (1)
// with g_k >= 0 and h_k = 0 under `where`, g_0 = 1, and k the `times` of the term. `basis` is z,
// `gram` the lower triangle of Q by rows, `polynomial` t. All numbers are fractions, as texts.
#pragma once

#include "io/json/json_reader.h"

namespace gainsmith::io {

/// Each is the inverse of the other; the reader has the checks of JsonReader alone, not those of
/// (1).
Json sum_of_squares_json(const model::SumOfSquaresRecord& record);
model::SumOfSquaresRecord sum_of_squares_of(const JsonReader& reader);

}  // namespace gainsmith::io
