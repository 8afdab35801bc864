// Few rows that hold all entries of a sparse symmetric matrix.
#pragma once

#include <vector>

#include "sdp/core/data.h"

namespace gainsmith::sdp {

/// Every entry (i, j) of the matrix has i or j among `rows`.
struct Cover {
  bool found = false;  ///< with at most n/4 rows; otherwise the rest means nothing
  std::vector<int> rows;
  std::vector<int> slot;  ///< for each term the place of its row in `rows`
};

/// Greedily: the row with most entries that are not covered yet, the first of them in a tie.
Cover cover_of(const Term* first, const Term* last, int n);

}  // namespace gainsmith::sdp
