// Whether a program has a solution: an identity in fractions, or what excludes all.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "sdp/solver.h"
#include "sos/identity.h"
#include "sos/reduce.h"

namespace gainsmith::sos {

struct Decision {
  Program program;                         ///< with the bases of the identity
  std::optional<std::vector<Rational>> u;  ///< of a yes, in decimals
  Identity identity;
  /// Of a no: an equation, or else moments of its equations.
  std::optional<Contradiction> contradiction;
  std::map<Key, Rational> moments;
  bool excluded = false;
  bool on_face = false;  ///< the bases are those of a face

  std::vector<double>
      inside;              ///< multipliers of the equations of the whole program, without u and t
  sdp::Solution solution;  ///< the last
  int iterations = 0;      ///< of the solver, in all
};

/// Of a program after reduce(). The solver is asked for a point far from singular; where all are
/// singular, on their face again, in more digits where its fractions are long. `level`: an equation
/// that a solution should nearly satisfy, which leaves points inside.
Decision decide(Program program, const sdp::Options& options,
                const std::optional<Equation>& level = std::nullopt);

}  // namespace gainsmith::sos
