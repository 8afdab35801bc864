// The identities of sums of squares in gain files.
#pragma once

#include "io/json_reader.h"

namespace gainsmith::io {

Json sum_of_squares_json(const model::SumOfSquaresRecord& record);
model::SumOfSquaresRecord sum_of_squares_of(const JsonReader& reader);

}  // namespace gainsmith::io
