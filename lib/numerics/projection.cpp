#include "numerics/projection.h"

#include "numerics/projection_sets.h"

namespace gainsmith::numerics {

template Projection<double> project_polytope(const Matrix&, const Matrix&, const Matrix&,
                                             const Matrix&);
template Projection<double> project_ellipsoid(const Matrix&, const Matrix&, const Matrix&,
                                              const Matrix&, const Matrix&);
template Projection<double> project_affine(const Matrix&, const Matrix&, const Matrix&,
                                           const Matrix&);

}  // namespace gainsmith::numerics
