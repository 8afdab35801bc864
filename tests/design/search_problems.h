// Problems with known answers that the tests of searches share.
#pragma once

#include <string>

namespace gainsmith::design::testing {

/// x'' + x' + (2 + k(t)) x = 0, k in [0, kmax]: one P exactly for kmax < 1 + 2 sqrt(2), by the
/// circle criterion.
inline const std::string kCircle = R"(problem: circle
method:
  method: quadratic-stability
  data: {kmax: scalar}
  unknowns: {P: symmetric 2}
  let: {A(k): "[0, 1; -2 - k, -1]"}
  require:
    positive: P > 0
    decrease: {forall: "k in [0, kmax]", that: "He(P*A(k)) < 0"}
data: {kmax: 1}
)";

/// The smallest x is (a - 2)^2 + (b - 3)^2 + 1, feasible up to 6.
inline const std::string kBowl = R"(problem: bowl
method:
  method: bowl
  parameters: {a: {default: 1, search: [0, 9]}, b: {default: 2, search: [0.01, 90]}}
  unknowns: {x: scalar}
  require: {floor: "x > (a - 2)^2 + (b - 3)^2 + 1", ceiling: x < 6}
  minimize: x
  gains: {K: 2*x}
)";

/// Feasible for c <= 4 - (a - 1)^2.
inline const std::string kRidge = R"(problem: ridge
method:
  method: ridge
  data: {a: scalar, c: scalar}
  unknowns: {x: scalar}
  require: {floor: x > 1, ceiling: "x < 5 - (a - 1)^2 - c"}
  minimize: x
search: {largest: {c: [-5, 9]}, tolerance: 1e-3, over: {a: [-2, 3]}, evaluations: 60}
)";

/// Feasible exactly for 0.29 < k < 0.31, between two values of the spread.
inline std::string window(double k) {
  return R"(problem: window
method:
  method: window
  data: {k: scalar}
  unknowns: {P: scalar}
  require: {pos: P > 1, win: "P*(1e-4 - (k - 0.3)^2) > 0"}
search: {largest: {k: [0, 1]}}
data: {k: )" +
         std::to_string(k) + "}\n";
}

}  // namespace gainsmith::design::testing
