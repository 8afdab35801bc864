// SDPA sparse files (.dat-s).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sdp/problem.h"

namespace gainsmith::sdp {

/// Reads a problem in the SDPA sparse format (Fujisawa, Fukuda, Kojima, Nakata, Yamashita: SDPA
/// user's manual; the dialect of SDPLIB):
///   comment lines that start with " or *, then
///   m  =  number of variables          (the rest of this and of the next line is a remark)
///   number of blocks
///   block sizes, a negative one for a diagonal block
///   c_1 ... c_m
///   matrix block row column value      one entry a line, matrix 0 = F_0, all counting from 1
/// Braces, parentheses and commas count as spaces; integers may be written as reals. Zero values
/// are dropped. `file_name` is for messages. InputError with file:line:column for anything else:
/// text that is no number, NaN or infinity, indices out of range, an off-diagonal entry of a
/// diagonal block, the same place twice (also mirrored: only one triangle may be given), a file
/// that ends early.
Problem read_sdpa(std::string_view text, const std::string& file_name);

/// The text of a problem in that format, numbers with 17 digits: read_sdpa gives the same doubles.
/// What they were rounded from (Entry::rest) is not written. `remarks`: comment lines before it.
std::string write_sdpa(const Problem& problem, const std::vector<std::string>& remarks = {});

}  // namespace gainsmith::sdp
