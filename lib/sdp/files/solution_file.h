// Solutions in the formats that other programs read.
#pragma once

#include <string>

#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::sdp {

/// The format of CSDP (Borchers, CSDP user's guide): x on the first line, then one line an entry,
///   matrix block row column value
/// with matrix 1 = X, matrix 2 = Y (CSDP's Z and X), upper triangles, nonzeros, counting from 1.
/// Numbers have 17 digits: reading them back gives the same doubles.
std::string csdp_solution(const Problem& problem, const Solution& solution);

/// The format of SDPA's result files: phase and objectives, then xVec, xMat and yMat in braces, a
/// dense block row by row, a diagonal one as one row.
std::string sdpa_solution(const Problem& problem, const Solution& solution);

}  // namespace gainsmith::sdp
