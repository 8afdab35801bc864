// Internal to lmi: collects the elements of one sparse matrix after the other, in dense arrays of
// rows x columns that serve all of them. An element costs O(1) to add, a matrix the sorting of its
// rows to take.
#pragma once

#include <vector>

#include "lmi/sparse.h"

namespace gainsmith::lmi {

/// Elements of one place add up in the order in which they come; what cancels is left out.
class Gatherer {
 public:
  Gatherer(int rows, int columns);

  void add(int row, int column, double value) {
    const auto at = static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) +
                    static_cast<std::size_t>(row);
    if (filled_[at] != 0) {
      values_[at] += value;
      return;
    }
    filled_[at] = 1;
    values_[at] = value;
    int& count = counts_[static_cast<std::size_t>(column)];
    touched_[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) +
             static_cast<std::size_t>(count++)] = row;
    ++elements_;
  }
  /// Both (row, column) and (column, row), which is once where they are the same place.
  void add_mirrored(int row, int column, double value) {
    if (row <= column)
      add(row, column, value);
    else
      add(column, row, value);
  }

  /// The matrix; then all is zero again.
  Sparse take();
  /// The symmetric matrix whose upper triangle was added.
  Sparse take_mirrored();

 private:
  /// Visits the elements that are not 0 column by column, and forgets them.
  template <class Visit>
  void drain(Visit visit);

  int rows_;
  int columns_;
  int elements_ = 0;
  std::vector<double> values_;  ///< rows x columns, column by column
  std::vector<char> filled_;    ///< whether an element was added to
  std::vector<int> touched_;    ///< the rows that were added to, in each column
  std::vector<int> counts_;     ///< of these, for each column
};

}  // namespace gainsmith::lmi
