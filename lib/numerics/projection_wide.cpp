// Both scalars are computed in Decimal100.
#include "numerics/projection_sets.h"

namespace gainsmith::numerics {

using Quad = MatrixOf<DoubleDouble>;
template Projection<DoubleDouble> project_polytope(const Quad&, const Quad&, const Quad&,
                                                   const Quad&);
template Projection<DoubleDouble> project_ellipsoid(const Quad&, const Quad&, const Quad&,
                                                    const Quad&, const Quad&);
template Projection<DoubleDouble> project_affine(const Quad&, const Quad&, const Quad&,
                                                 const Quad&);

using Wide = MatrixOf<Decimal100>;
template Projection<Decimal100> project_polytope(const Wide&, const Wide&, const Wide&,
                                                 const Wide&);
template Projection<Decimal100> project_ellipsoid(const Wide&, const Wide&, const Wide&,
                                                  const Wide&, const Wide&);
template Projection<Decimal100> project_affine(const Wide&, const Wide&, const Wide&, const Wide&);

}  // namespace gainsmith::numerics
