// The unknown matrices as one vector x of scalars, and back.
//
// Packing: unknowns in the order of the method. A symmetric n x n matrix takes n(n+1)/2 scalars,
// column by column of its lower triangle: x = (M11, M21, ..., Mn1, M22, ...), without factors
// sqrt(2); a full r x c matrix takes r c scalars column by column; a diagonal matrix takes its
// diagonal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/instance.h"
#include "numbers/types/real.h"

namespace gainsmith::lmi {

struct Unknown {
  std::string name;
  model::Structure structure = model::Structure::full;
  expr::Shape shape;
  int first = 1;  ///< index of its first scalar, counted from 1; x_0 = 1 is the constant
  int count = 0;
  bool whole = false;  ///< occurs as a matrix in products (products.h), not by its scalars

  /// The places (row, column) of scalar `first + k`: one, or two mirrored ones.
  std::vector<std::pair<int, int>> places(int k) const;
};

class Unknowns {
 public:
  static constexpr int kLarge = 100;  ///< scalars

  Unknowns() = default;
  /// With an unknown of at least `large` scalars the matrices occur as such in products; below
  /// their scalars cost less.
  explicit Unknowns(const std::vector<model::UnknownMatrix>& matrices, int large = kLarge);

  /// The number m of scalars.
  int size() const { return size_; }
  const std::vector<Unknown>& list() const { return list_; }
  /// nullptr for no such name.
  const Unknown* find(const std::string& name) const;
  /// "P1(2,1)" for scalar i = 1..m.
  std::string scalar_name(int i) const;
  /// The matrices of a vector x of m scalars (x[i-1] is scalar i).
  numbers::Values values(const std::vector<double>& x) const;

 private:
  std::vector<Unknown> list_;
  int size_ = 0;
};

}  // namespace gainsmith::lmi
