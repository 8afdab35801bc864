// Facial reduction: programs whose equations force Y on a face of the cone.
#pragma once

#include <optional>
#include <vector>

#include "sdp/core/iterate.h"
#include "sdp/core/presolve.h"
#include "sdp/solution.h"

namespace gainsmith::sdp {

/// d with c'd = 0 and A*(d) = sum d_i F_i = U S U', S > 0, exposes a face (Borwein, Wolkowicz
/// 1981): every feasible Y has A*(d).Y = c'd = 0, hence Y U = 0 and Y = N Z N', Z >= 0, with N a
/// basis of the kernel of U'. No Y is in the cone's interior, and the x of the primal run away
/// along d.
struct Face {
  /// A row of N is a combination of rows of Z.
  struct Part {
    int row = 0;
    double weight = 0;
  };
  struct Rows {
    int number = -1;                       ///< of the block of Z; -1: Y is zero in this block
    int size = 0;                          ///< rows of that block
    std::vector<std::vector<Part>> parts;  ///< by row of Y
    std::vector<char> kept;                ///< by row of Y: is it a row of Z?
  };
  std::vector<DoubleDouble> direction;  ///< d of the original problem
  std::vector<Rows> blocks;             ///< by block of the original problem
};

/// The face that a point of an ended run points to: where X has eigenvalues far above all others, d
/// is near x. It is made exact by Newton's method for rank(A*(d)) = rank(U), c'd = 0. Nothing where
/// that leaves more than rounding. Rows of N are unit vectors but for as many as U has columns;
/// weights that are integers but for rounding become integers, so data stay sparse.
std::optional<Face> find_face(const Problem& problem, const Presolved& presolved,
                              const Iterate<double>& point);

/// The program over Z: F_i -> N'F_i N. What is rounding beside the entries of F_i becomes zero;
/// where nothing is left of F_i, c_i becomes zero too.
Problem restrict_to(const Face& face, const Problem& problem);

/// The point (x, N'X N, Z) of the program over Z, Y = N Z N' where N has rows of I and x without
/// its part along d, in its working problem.
Iterate<double> restrict_to(const Face& face, const Problem& problem, const Point<double>& point,
                            const Problem& program, const Presolved& presolved);

/// Y = N Z N' with a rounding of I, so that it has a Cholesky factor; x + t d with the least t of a
/// sequence of powers for which sum x_i F_i - F_0 + s I has one, and that as X: s I is a primal
/// infeasibility of `tolerance`. Nothing when no t does.
std::optional<Point<DoubleDouble>> lift(const Face& face, const Problem& problem,
                                        const Solution& solution, double tolerance);

}  // namespace gainsmith::sdp
