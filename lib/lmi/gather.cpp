#include "lmi/gather.h"

#include <algorithm>

namespace gainsmith::lmi {

namespace {

std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// A matrix with room for `counts` elements in each column, whose index arrays are set.
Sparse with_room(int rows, const std::vector<int>& counts) {
  Sparse result(rows, static_cast<Eigen::Index>(counts.size()));
  int* outer = result.outerIndexPtr();
  outer[0] = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) outer[c + 1] = outer[c] + counts[c];
  result.resizeNonZeros(outer[counts.size()]);
  return result;
}

}  // namespace

Gatherer::Gatherer(int rows, int columns)
    : rows_(rows),
      columns_(columns),
      values_(size(rows) * size(columns), 0.0),
      filled_(values_.size(), 0),
      touched_(values_.size()),
      counts_(size(columns), 0) {}

template <class Visit>
void Gatherer::drain(Visit visit) {
  for (int c = 0; c < columns_; ++c) {
    int& count = counts_[size(c)];
    if (count == 0) continue;
    const std::size_t first = size(c) * size(rows_);
    int* rows = touched_.data() + first;
    if (!std::is_sorted(rows, rows + count)) std::sort(rows, rows + count);
    for (int k = 0; k < count; ++k) {
      const std::size_t at = first + size(rows[k]);
      if (values_[at] != 0) visit(rows[k], c, values_[at]);
      filled_[at] = 0;
    }
    count = 0;
  }
  elements_ = 0;
}

Sparse Gatherer::take() {
  Sparse result(rows_, columns_);
  result.reserve(elements_);
  int begun = -1;
  // Columns without elements have to be begun too.
  const auto begin = [&](int column) {
    while (begun < column) result.startVec(++begun);
  };
  drain([&](int row, int column, double value) {
    begin(column);
    result.insertBack(row, column) = value;
  });
  begin(columns_ - 1);
  result.finalize();
  return result;
}

Sparse Gatherer::take_mirrored() {
  std::vector<int> rows, columns;
  std::vector<double> values;
  rows.reserve(size(elements_));
  columns.reserve(size(elements_));
  values.reserve(size(elements_));
  std::vector<int> counts(size(columns_), 0);
  drain([&](int row, int column, double value) {
    rows.push_back(row);
    columns.push_back(column);
    values.push_back(value);
    ++counts[size(column)];
    if (row != column) ++counts[size(row)];
  });
  Sparse result = with_room(rows_, counts);
  // Column by column each one is filled from above: first by its own upper part.
  std::vector<int> next(result.outerIndexPtr(), result.outerIndexPtr() + columns_);
  const auto put = [&](int row, int column, double value) {
    const int at = next[size(column)]++;
    result.innerIndexPtr()[at] = row;
    result.valuePtr()[at] = value;
  };
  for (std::size_t k = 0; k < values.size(); ++k) {
    put(rows[k], columns[k], values[k]);
    if (rows[k] != columns[k]) put(columns[k], rows[k], values[k]);
  }
  return result;
}

}  // namespace gainsmith::lmi
