// The number type "pack of points": one value is a matrix at many points of a run at once, stored
// as a structure of arrays, so that an instruction of a claim costs one loop over the points.
#pragma once

#include <Eigen/Core>

#include "expr/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// A matrix at kLanes points. Each lane is computed alone and all lanes alike, so a value
/// does not depend on the points beside it.
struct Pack {
  static constexpr int kLanes = 64;

  bool same = true;  ///< equal at all points: `matrix` holds it, else `lanes`
  Eigen::Index rows = 0;
  Eigen::Index cols = 0;
  Matrix matrix;
  Eigen::ArrayXXd lanes;  ///< kLanes x elements; the matrix's elements column by column
};

/// The value that is `matrix` at all points.
Pack constant_pack(const Matrix& matrix);

/// Pack arithmetic (expr/number_type.h). Values that do not move are computed by RealAlgebra,
/// errors included; a lane in which an operation has no result, or overflows, holds a NaN or an
/// infinity and goes on.
struct PackAlgebra {
  using Value = Pack;
  void apply(const expr::Instruction& instruction, expr::Operands<Pack> operands, Pack& out) const;
};

}  // namespace gainsmith::numbers
