// A small valid problem as text, to be broken in one place at a time.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "bind/bind.h"
#include "io/yaml/problem_yaml.h"
#include "methods/methods.h"
#include "support/input_error.h"

namespace gainsmith::io {

inline const std::string kProblem = R"(problem: small
method: sampled-data-hybrid
data:
  A: [[0.2, -1.01], [1, 0]]
  C: [[0.5, -1]]
  T1: 0.5
  T2: 0.7
  QF: I
parameters: {delta: 0.03, a1: 100}
synthesis: {margin: 1e-6, gain_bound: 100}
campaign:
  runs: 20
  seed: 3
  horizon: 10
  first: T1
  sampling: [uniform, {constant: T1}, {list: [T1, T2]}]
  initial:
    z: {box: [-10, 10]}
    zh: {list: [[1, 2], [3, 4]]}
    th: C*z
expect:
  verdict: yes
  status: optimal
  campaign: held
  active_bounds: [g]
  values:
    objective: {value: 1.5, relative: 1e-3}
    L: {value: [1, 2], absolute: 0.1}
)";

inline const std::string kMethod = R"(method: small
source: none
summary: for tests
data:
  A: n x n
  b: {shape: n, default: "[1; 1]", help: a column}
parameters:
  delta: {default: 0.1, help: decay}
  rate: 2
assume:
  decay: delta > 0
unknowns: {P: symmetric n, g: scalar}
let:
  mu(tau): exp(delta*tau)
require:
  positive: P > 0
  flow:
    forall: tau in [0, 1]
    that: He(P*A) + mu(tau)*P < g*I
minimize: g
gains:
  K: b'*P
plant:
  state: {z: n}
  output: {y: b'*z}
  flow: {z: A*z}
timer:
  tau: {reset: [1, 2]}
signals:
  w: 2*y
claims:
  falls: {nonincreasing: z'*P*z}
  cheap: {cost: {flow: w^2}, below: z'*P*z}
  small: {shrinks: norm(z), to: 0.1}
)";

inline const MethodLibrary& library() {
  static const MethodLibrary kLibrary{[](const std::string& name) { return methods::find(name); },
                                      methods::names()};
  return kLibrary;
}

inline model::Problem read_problem(const std::string& text) {
  return parse_problem(text, "p.yaml", library());
}

inline model::DesignPtr bound(const std::string& text) {
  return bind::bind(read_problem(text)).design;
}

/// `text` with its first `from` replaced by `to`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "no '" << from << "' in the text of the test";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A text, where its mistake is and a part of the message.
struct Mistake {
  std::string from;
  std::string to;
  int line;
  int column;
  std::string message;
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << "'" << mistake.from << "' -> '" << mistake.to << "'";
}

}  // namespace gainsmith::io
