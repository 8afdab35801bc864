// Sampled linear systems for the tests of packs.
#pragma once

#include <string>
#include <vector>

#include "verify/pack_cases.h"

namespace gainsmith::verify::linear_packs {

using Case = PackCase;

/// A text with another part.
inline std::string with(std::string text, const std::string& part, const std::string& other) {
  return text.replace(text.find(part), part.size(), other);
}

/// Bounds lie among what the runs reach, so that some hold and some violate.
inline const std::vector<Case>& linear_cases() {
  static const std::vector<Case> cases = [] {
    std::vector<Case> made = {
        {"a jump that turns and grows", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}}
    flow: {x: "[-0.1, 1; -1, -0.1]*x"}
    jump: {x: "[0.6, 0.5; -0.9, 0.75]*x"}
  timer: {tau: {reset: [0.1, 0.6], first: [0, 0.6]}}
  claims:
    falls: {nonincreasing: "x'*x"}
    cost: {cost: {flow: "x'*x", jump: 0.1*x(1)^2}, below: 3*exp(0.2*tau)*x'*x}
    error: {shrinks: norm(x), to: 0.5}
campaign: {runs: 160, horizon: 3, initial: {x: {box: [-2, 3]}}}
)yaml"},
        {"an observer whose error does not depend on its plant", R"yaml(problem: p
method:
  method: m
  plant:
    state: {z: {shape: 2}}
    output: {y: "[1, 0]*z"}
    flow: {z: "[0.3, 1; -1, 0.2]*z"}
  observer:
    state: {zh: {shape: 2, start: 0}, th: {shape: 1}}
    flow: {zh: "[0.3, 1; -1, 0.2]*zh + [0.5; 0.1]*th", th: -2*th}
    jump: {zh: "zh + [0.5; 0.2]*(y - [1, 0]*zh)", th: "0.5*(y - [1, 0]*zh)"}
  timer: {tau: {reset: [0.2, 0.7], first: [0, 0.7]}}
  claims:
    cost: {cost: {flow: "(z - zh)'*(z - zh)"}, below: 0.9*(z - zh)'*(z - zh)}
    error: {shrinks: norm(z - zh), to: 0.02}
campaign: {runs: 160, horizon: 12, initial: {z: {ellipsoid: {matrix: "[1, 0.2; 0.2, 0.5]", level: 4}}, th: "[1, 0]*z"}}
)yaml"},
        {"a constant input", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}}
    flow: {x: "[-1, 0.5; -0.5, -1]*x + [1; 0.2]"}
    jump: {x: "[0.7, 0; 0, 1]*x + [0.1; -0.3]"}
  timer: {tau: {reset: [0.1, 0.4], first: [0, 0.4]}}
  claims:
    cost: {cost: {flow: "0.3*(x(1) - x(2))^2", jump: 0.01*(x(2) + 1)^2}, below: "1.2 + x'*x"}
    distance: {shrinks: "norm(x - [0.5; -0.6])", to: 0.4}
campaign: {runs: 160, horizon: 5, initial: {x: {box: ["[-1; -2]", "[2; 2]"]}}}
)yaml"},
        {"one length, from a list of starts", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 3}}
    flow: {x: "[0, 1, 0; 0, 0, 1; -1, -2, -1.2]*x"}
    jump: {x: "[1, 0, 0; 0, 0.9, 0; 0, 0, 0]*x"}
  timer: {tau: {reset: [0.25, 0.25], first: [0.1, 0.2]}}
  claims:
    cost: {cost: {flow: "x(1)^2", jump: "x(3)^2"}, below: 2*x'*x}
    shrinks: {shrinks: "x'*x", to: 0.2}
campaign: {runs: 160, horizon: 4.1, initial: {x: {list: ["[1; 0; 0]", "[0; 1; 0]", "[0; 0; 1]", "[1; -1; 2]", "[0.2; 1; -1]"]}}}
)yaml"},
        {"laws without draws", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}}
    flow: {x: "[-0.2, 2; -2, -0.2]*x"}
    jump: {x: "[1.1, 0; 0, 0.6]*x"}
  timer: {tau: {reset: [0.2, 1], first: [0.4, 0.4]}}
  claims:
    falls: {nonincreasing: "exp(-0.1*tau)*x'*x"}
    error: {shrinks: norm(x), to: 0.2}
campaign: {runs: 160, horizon: 6, initial: {x: {box: [-1, 1]}}, sampling: [sinusoid, golden, {list: [0.3, 0.9, 0.5]}, {constant: 0.45}, extremes]}
)yaml"},
        {"a gain that depends on a clock", R"yaml(problem: p
method:
  method: m
  let: {A: "[0.2, -1.01; 1, 0]", C: "[0.5, -1]"}
  plant:
    state: {z: {shape: 2}}
    output: {y: C*z}
    flow: {z: A*z}
  observer:
    state: {zh: {shape: 2, start: 0}, s: {shape: 1, start: 0.3}}
    flow: {zh: A*zh, s: 1}
    jump: {zh: "zh + ([-0.1; -0.6] + [0.15; 0.05]*s)*(y - C*zh)", s: 0}
  timer: {tau: {reset: [0.5, 2.2]}}
  claims:
    falls: {nonincreasing: "(expm(-A*s)*(z - zh))'*[1, 0.1; 0.1, 1]*(expm(-A*s)*(z - zh))"}
    cost: {cost: {flow: "(z - zh)'*(z - zh)"}, below: 20*(z - zh)'*(z - zh)}
    error: {shrinks: norm(z - zh), to: 0.2}
campaign: {runs: 160, horizon: 12, initial: {z: {box: [-2, 3]}}}
)yaml"},
        {"a jump that forgets everything", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}}
    flow: {x: "[0.5, 1; 0, 0.2]*x"}
    jump: {x: 0*x}
  timer: {tau: {reset: [0.5, 1], first: [0.2, 1]}}
  claims:
    cost: {cost: {flow: "x'*x"}, below: 2*x'*x}
    error: {shrinks: norm(x), to: 0.1}
campaign: {runs: 160, horizon: 3, initial: {x: {box: [-1, 1]}}}
)yaml"}};
    made.push_back({"a tolerance of a value that flows keep", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}}
    flow: {x: "[0, 1; -1, 0]*x"}
    jump: {x: "[1.01, 0; 0, 0.8]*x"}
  timer: {tau: {reset: [0.1, 2], first: [0, 2]}}
  claims: {falls: {nonincreasing: "x'*x", tolerance: 0.01}, error: {shrinks: norm(x), to: 0.5}}
campaign: {runs: 160, horizon: 3, initial: {x: {box: [-2, 3]}}}
)yaml"});
    made.push_back(
        {"a mode that lives next to jumps alone",
         with(with(made[1].text, "[0.5; 0.1]*th\", th: -2*th", "[2000; 400]*th\", th: -8000*th"),
              "[0.5; 0.2]*(y", "[0.4; 0.2]*(y")});
    made.push_back({"starts around a center", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2}, z: {shape: 1}}
    flow: {x: "[-0.1, 1; -1, -0.1]*x", z: -z}
    jump: {x: "[0.6, 0.5; -0.9, 0.75]*x + [0.1; 0]*z"}
  timer: {tau: {reset: [0.1, 0.6], first: [0, 0.6]}}
  claims:
    falls: {nonincreasing: "x'*x"}
    error: {shrinks: norm(x), to: 0.5}
campaign: {runs: 160, horizon: 3, initial: {x: {normal: {mean: [1, 0], covariance: "[1, 1; 1, 1]"}}, z: {lognormal: 0.5}}}
)yaml"});
    return made;
  }();
  return cases;
}

}  // namespace gainsmith::verify::linear_packs
