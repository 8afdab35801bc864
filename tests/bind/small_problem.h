// A small method and problem as YAML, to be changed in one place at a time.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "bind/bind.h"
#include "io/yaml/problem_yaml.h"

namespace gainsmith::bind {

inline const std::string kSmallMethod = R"yaml(method: small
data:
  A: n x n
  b: n
  Q: {shape: symmetric n, default: 2*I}
  D: {shape: diagonal n, default: I}
  T1: scalar
  T2: {shape: scalar, default: 2*T1}
  extra: {shape: n + m x 1, default: "ones(n + 1, 1)"}
  M: {shape: m x m, default: 3}
parameters: {delta: {default: T1/10}, rate: 1}
assume: {sampling: 0 < T1 <= T2, decay: delta > 0}
unknowns: {P: symmetric n, X: n x m, g: scalar}
let: {f(t): exp(delta*t)}
require:
  flow: {forall: "tau in [0, T2]", that: "He(P*A) + f(tau)*Q < g*I"}
minimize: g
gains: {K: b'*P, A: A}
plant: {state: {z: n}, output: {y: b'*z}, flow: {z: A*z}, jump: {z: z/2}}
observer: {state: {zh: n, th: 1}, flow: {th: K*zh}}
timer: {s: {reset: [T1, T2]}}
signals: {e: z - zh}
claims:
  falls: {nonincreasing: e'*P*e + s}
  cheap: {cost: {flow: y^2, jump: th^2}, below: g}
  small: {shrinks: norm(e), to: rate/100}
)yaml";

inline const std::string kSmallProblem = R"(problem: p
method: small
data:
  A: [[1, 2], [3, 4]]
  b: [5, 6]
  T1: 0.5
campaign:
  horizon: 10*T2
  first: T1
  sampling: [{constant: T1}, {list: [T1, T2]}]
  initial: {z: [1, 2], zh: {box: [-1, [1, 2]]}, th: {list: [1, b'*z]}}
expect:
  values:
    objective: {value: 1, absolute: 1}
    trace(P): {value: T1, absolute: 1}
    K: {value: [1, 2], absolute: 1}
)";

inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "no '" << from << "' in the text of the test";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline model::Problem small_problem(const std::string& text = kSmallProblem,
                                    const std::string& method = kSmallMethod) {
  return io::parse_problem(text, "p.yaml", {[&](const std::string&) { return method; }, {"small"}});
}

/// A problem and its instance.
struct Small {
  std::shared_ptr<const model::Problem> problem;
  model::Instance instance;

  explicit Small(const std::string& text = kSmallProblem,
                 const std::string& method = kSmallMethod) {
    problem = std::make_shared<const model::Problem>(small_problem(text, method));
    instance = bind(problem);
  }

  const model::Design& design() const { return *instance.design; }
};

}  // namespace gainsmith::bind
