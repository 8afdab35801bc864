#include "sdp/schur/cover.h"

#include <algorithm>

namespace gainsmith::sdp {

Cover cover_of(const Term* first, const Term* last, int n) {
  Cover cover;
  const auto count = static_cast<std::size_t>(last - first);
  cover.slot.assign(count, -1);
  // The entries of each row that are not covered yet.
  std::vector<int> degree(static_cast<std::size_t>(n), 0);
  for (const Term* term = first; term != last; ++term) {
    ++degree[static_cast<std::size_t>(term->row)];
    if (term->row != term->column) ++degree[static_cast<std::size_t>(term->column)];
  }
  for (std::size_t left = count; left > 0;) {
    // More than n/4 rows are no cover: then a full product costs less.
    if (4 * (cover.rows.size() + 1) > static_cast<std::size_t>(n)) return cover;
    const int row =
        static_cast<int>(std::max_element(degree.begin(), degree.end()) - degree.begin());
    for (std::size_t t = 0; t < count; ++t) {
      if (cover.slot[t] >= 0 || (first[t].row != row && first[t].column != row)) continue;
      cover.slot[t] = static_cast<int>(cover.rows.size());
      --degree[static_cast<std::size_t>(first[t].row)];
      if (first[t].row != first[t].column) --degree[static_cast<std::size_t>(first[t].column)];
      --left;
    }
    cover.rows.push_back(row);
  }
  cover.found = true;
  return cover;
}

}  // namespace gainsmith::sdp
