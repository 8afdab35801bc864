#include "lmi/unknowns.h"

#include <algorithm>

#include "base/named.h"

namespace gainsmith::lmi {

std::vector<std::pair<int, int>> Unknown::places(int k) const {
  const int rows = shape.rows;
  switch (structure) {
    case model::Structure::diagonal:
      return {{k, k}};
    case model::Structure::symmetric: {
      // Column c of the lower triangle has n - c scalars.
      int column = 0;
      while (k >= rows - column) {
        k -= rows - column;
        ++column;
      }
      const int row = column + k;
      if (row == column) return {{row, column}};
      return {{row, column}, {column, row}};
    }
    case model::Structure::full:
    case model::Structure::scalar:
      break;
  }
  return {{k % rows, k / rows}};
}

Unknowns::Unknowns(const std::vector<model::UnknownMatrix>& matrices, int large) {
  for (const model::UnknownMatrix& declared : matrices) {
    Unknown unknown;
    unknown.name = declared.name;
    unknown.structure = declared.structure;
    unknown.shape = declared.shape;
    unknown.first = size_ + 1;
    const int n = unknown.shape.rows;
    unknown.count = unknown.structure == model::Structure::symmetric  ? n * (n + 1) / 2
                    : unknown.structure == model::Structure::diagonal ? n
                                                                      : unknown.shape.size();
    size_ += unknown.count;
    list_.push_back(std::move(unknown));
  }
  // Matrices of so few scalars are not kept whole: their scalars cost less.
  constexpr int kFew = 3;
  const auto is_matrix = [](const Unknown& unknown) {
    return unknown.structure == model::Structure::symmetric ||
           unknown.structure == model::Structure::full;
  };
  // One large matrix makes all matrices whole, but for those of few scalars.
  const bool some = std::any_of(list_.begin(), list_.end(), [&](const Unknown& unknown) {
    return is_matrix(unknown) && unknown.count >= large;
  });
  for (Unknown& unknown : list_) unknown.whole = some && is_matrix(unknown) && unknown.count > kFew;
}

const Unknown* Unknowns::find(const std::string& name) const { return find_named(list_, name); }

std::string Unknowns::scalar_name(int i) const {
  for (const Unknown& unknown : list_) {
    if (i < unknown.first || i >= unknown.first + unknown.count) continue;
    if (unknown.shape.is_scalar()) return unknown.name;
    const auto [row, column] = unknown.places(i - unknown.first).front();
    return unknown.name + "(" + std::to_string(row + 1) + "," + std::to_string(column + 1) + ")";
  }
  return "x" + std::to_string(i);
}

numbers::Values Unknowns::values(const std::vector<double>& x) const {
  numbers::Values result;
  for (const Unknown& unknown : list_) {
    numbers::Matrix matrix = numbers::Matrix::Zero(unknown.shape.rows, unknown.shape.cols);
    for (int k = 0; k < unknown.count; ++k)
      for (const auto& [row, column] : unknown.places(k))
        matrix(row, column) =
            x[static_cast<std::size_t>(unknown.first) + static_cast<std::size_t>(k) - 1];
    result[unknown.name] = std::move(matrix);
  }
  return result;
}

}  // namespace gainsmith::lmi
