// Problems whose campaigns packs run, by name.
#pragma once

#include <ostream>
#include <string>

namespace gainsmith::verify {

struct PackCase {
  const char* name;
  std::string text;
};

inline void PrintTo(const PackCase& one, std::ostream* out) { *out << one.name; }

// Bounds lie among what the runs reach, so that some hold and some violate.
inline const PackCase kPackCases[] = {
    {"a sampled observer of a pendulum with noise", R"yaml(problem: p
method:
  method: m
  let: {f(x): "[x(2); -9.81*sin(x(1)) - 0.1*x(2)]"}
  events: {sample: {every: [0.05, 0.2], lost: {probability: 0.3, in_a_row: 2}}}
  noise: {w: {normal: 0.02, new at: sample}, d: {uniform: [-0.5, 0.5], every: 0.37}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    output: {y: {value: x(1) + w, at: sample}}
    flow: {x: "f(x) + [0; d]"}
  observer:
    state: {xh: {shape: 2, start: 0}, P: {shape: symmetric 2, start: I}}
    flow: {xh: f(xh), P: "He(jacobian(f(xh), xh)*P) + 0.01*I"}
    at: {sample: {let: {C: "[1, 0]", K: P*C'/(C*P*C' + 0.001)}, xh: xh + K*(y - C*xh), P: "(I - K*C)*P*(I - K*C)' + 0.001*K*K'"}}
  claims:
    small: {shrinks: norm(x - xh), to: 0.08}
    error: {below: norm(x - xh), bound: 0.25, after: 2}
    angle: {below: abs(x(1)), bound: 1.0}
    sampled: {below: norm(x - xh), bound: 0.24, over: sample, after: 1}
    trace: {above: "P(1, 1)", bound: 1e-4}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"starts and noise around centers", R"yaml(problem: p
method:
  method: m
  data: {V: 2 x 2, k: scalar}
  events: {sample: {every: 0.2}}
  noise: {d: {normal: {covariance: V}, every: 0.13}, w: {lognormal: 0.3, new at: sample}, c: {normal: 1}}
  plant:
    state: {x: {shape: 2}, z: {shape: 1, start: 1 + 0.2*c}}
    flow: {x: "[x(2); -k*sin(x(1)) - 0.3*x(2)] + d", z: -z*w + 0.1*c}
    at: {sample: {z: 0.9*z + 0.05*w}}
  claims:
    angle: {below: abs(x(1)), bound: 1.6}
    rest: {below: z, bound: 1.25}
data: {V: [[0.5, 0.4], [0.4, 0.5]], k: 2}
uncertain: {k: {lognormal: 0.2}}
campaign: {runs: 96, horizon: 3, initial: {x: {normal: {mean: [0.5, 0], covariance: V}}}}
)yaml"},
    {"a thermostat with two modes", R"yaml(problem: p
method:
  method: m
  events:
    off: {when: q == 1 and T >= 22}
    on: {when: q == 0 and T <= 18}
  noise: {outside: {uniform: [-5, 5]}}
  plant:
    mode: {q: 1}
    state: {T: {shape: 1, start: 20}}
    flow: {T: "0.1*(outside - T) + 4*q + 0.2*sin(t)"}
    at: {off: {q: 0}, on: {q: 1}}
  claims:
    hot: {below: T, bound: 22.001}
    swing: {above: T, bound: 17.5}
    settled: {below: T, bound: 21.6, over: on}
campaign: {runs: 96, horizon: 12, initial: {T: {box: [17.9, 23]}}}
)yaml"},
    {"a force that changes where it is passed, and a clipped input", R"yaml(problem: p
method:
  method: m
  inputs: {u: "clip(3*sin(t), -2, 2)"}
  plant:
    state: {x: {shape: 2, start: "[1; 0.5]"}}
    flow: {x: "[x(2); -4*x(1) - 0.2*x(2) + u + where(x(1) > 0.2, -1, 1)]"}
  claims:
    far: {below: x(1), bound: 1.4}
    fast: {below: abs(x(2)), bound: 2.4}
    least: {above: "min(x)", bound: -2.4}
campaign: {runs: 96, horizon: 5, initial: {x: {box: [-1, 1]}}}
)yaml"},
    // Its correction saturates on most of the way, and its estimate is cut off.
    {"an observer that saturates", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    output: {y: x(1) + 0.3*sin(32*t)}
    flow: {x: "[x(2); x(1) - x(1)^3]"}
  observer:
    state: {z: {shape: 2, start: 0}}
    flow: {z: "[z(2) + clip(8*(y - z(1)), -1, 1); clip(z(1) - z(1)^3, -0.3, 0.3) + 16*(y - z(1))]"}
  claims:
    near: {below: norm(x - z), bound: 1.5, after: 1}
    shrinks: {shrinks: norm(x - z), to: 0.7}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1.5, 1.5]}}}
)yaml"},
    // At the wall x(1) is -0.455 up to rounding, and rises through it without an event.
    {"a pendulum that a wall throws back", R"yaml(problem: p
method:
  method: m
  events: {hit: {falls: x(1) + 0.455}}
  plant:
    state: {x: {shape: 2, start: 0}}
    flow: {x: "[x(2); -5.269*sin(x(1)) - 0.336*x(2)]"}
    at: {hit: {x: "[x(1); -0.843*x(2)]"}}
  claims:
    slow: {below: abs(x(2)), bound: 1, after: 2}
    wall: {above: x(1), bound: -0.46}
    few: {below: count(hit), bound: 3}
campaign: {runs: 96, horizon: 6, initial: {x: {box: ["[0; -1]", "[1.3; 1.2]"]}}}
)yaml"},
    {"a ball with drag", R"yaml(problem: p
method:
  method: m
  events: {impact: {when: x(1) <= 0 and x(2) < 0}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    flow: {x: "[x(2); -9.81 - 0.1*x(2)*abs(x(2))]"}
    at: {impact: {x: "[0; -0.8*x(2)]"}}
  claims:
    energy: {nonincreasing: 9.81*x(1) + x(2)^2/2}
    speed: {below: abs(x(2)), bound: 5}
    low: {below: x(1), bound: 0.9, after: 0.8}
campaign: {runs: 96, horizon: 1.6, initial: {x: {box: ["[0.5; -1]", "[1.5; 1]"]}}}
)yaml"},
    {"a neuron that fires", R"yaml(problem: p
method:
  method: m
  events: {spike: {rises: v - 1}}
  plant:
    state: {v: {shape: 1, start: 0}, w: {shape: 1, start: 0}}
    flow: {v: "2*v^2 - w + 0.9", w: "0.5*(0.6*v - w)"}
    at: {spike: {v: 0.1, w: w + 0.2}}
  claims:
    slow: {below: w, bound: 0.6}
    height: {below: v, bound: 1.0001}
campaign: {runs: 96, horizon: 8, initial: {v: {box: [-0.2, 0.5]}, w: {box: [0, 0.3]}}}
)yaml"},
    {"a filter with two outputs, of a plant that is sampled at two times", R"yaml(problem: p
method:
  method: m
  events:
    one: {every: [0.1, 0.3]}
    two: {at: [0.5, 1, 1.5], if: plant.x(1) > 0}
  plant:
    state: {x: {shape: 3, start: 0}}
    output: {y: {value: "x(1:2)", at: one}}
    flow: {x: "[x(2); x(3) - x(1); -x(3) + 0.1*x(1)*x(2)]"}
    at: {two: {x: "x + [0; 0; 0.1]"}}
  observer:
    state: {xh: {shape: 3, start: 0}, P: {shape: symmetric 3, start: I}}
    flow: {xh: "[xh(2); xh(3) - xh(1); -xh(3) + 0.1*xh(1)*xh(2)]", P: "0.02*I"}
    at: {one: {let: {C: "[1, 0, 0; 0, 1, 0]", K: P*C'*inv(C*P*C' + 0.1*I)}, xh: xh + K*(y - C*xh), P: "(I - K*C)*P*(I - K*C)' + 0.1*K*K'"}}
  claims:
    small: {shrinks: norm(x - xh), to: 0.2}
    decrease: {nonincreasing: (x - xh)'*(x - xh)}
campaign: {runs: 96, horizon: 3, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"a claim on a rate, with held noise", R"yaml(problem: p
method:
  method: m
  noise: {w: {normal: 1, every: 0.1}}
  plant:
    state: {x: {shape: 2, start: 0}}
    flow: {x: "[x(2); -2*x(1) - 3*x(2) + w]"}
  claims:
    energy: {below: "rate(2*x(1)^2 + x(2)^2) - w^2/6", bound: 1e-6}
    power: {below: "rate(x'*x)", bound: 1.5}
    speed: {below: abs(rate(x(1))), bound: 1.2}
campaign: {runs: 96, horizon: 4, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"norms that come near 0, with held noise", R"yaml(problem: p
method:
  method: m
  noise: {w: {normal: 0.7, every: 0.1}}
  plant:
    state: {x: {shape: 2, start: 0}}
    flow: {x: "[x(2); -4*x(1) - 0.5*x(2) - 0.1*abs(x(2))*x(2) + w]"}
  claims:
    small: {below: norm(x), bound: 1.6}
    away: {above: norm(x), bound: 0.05}
    calm: {below: norm(x), bound: 0.8, after: 2}
    falls: {shrinks: norm(x), to: 0.6}
campaign: {runs: 96, horizon: 5, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"an oscillator with limits", R"yaml(problem: p
method:
  method: m
  events: {turn: {crosses: x(2)}}
  plant:
    state: {x: {shape: 2, start: 0}, n: {shape: 1, start: 0}}
    flow: {x: "[x(2); 1.5*(1 - x(1)^2)*x(2) - x(1)]"}
    at: {turn: {n: n + 1}}
  claims:
    few: {below: n, bound: 3.5}
    width: {below: x(1)^2, bound: 4.06}
    rate: {below: max(abs(x)), bound: 3}
campaign: {runs: 96, horizon: 9, initial: {x: {box: [-2.5, 2.5]}}}
)yaml"},
    {"costs of flows and jumps", R"yaml(problem: p
method:
  method: m
  events: {sample: {every: [0.1, 0.3]}}
  noise: {w: {normal: 0.05, new at: sample}}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}}
    output: {y: {value: x(1) + w, at: sample}}
    flow: {x: "[x(2); -sin(x(1)) - x(2)]"}
  observer:
    state: {xh: {shape: 2, start: 0}}
    flow: {xh: "[xh(2); -sin(xh(1)) - xh(2)]"}
    at: {sample: {xh: "xh + [0.5; 0.2]*(y - xh(1))"}}
  claims:
    energy: {cost: {flow: x'*x}, below: 2.2*x'*x + 0.3}
    both: {cost: {flow: norm(x - xh), jump: (y - xh(1))^2}, below: 2}
    jumps: {cost: {jump: w^2 + abs(x(1))}, below: 5}
    signed: {cost: {flow: x(2)}, below: 0.05}
    eased: {cost: {flow: x'*x}, below: 0.5*x'*x, tolerance: 0.5}
    none: {cost: {}, below: x'*x}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"norms of 0, exponentials of matrices, limits at the start", R"yaml(problem: p
method:
  method: m
  events: {sample: {every: [0.1, 0.3]}}
  let: {A: "[0, 1; -2, -0.3]", rate: lambda_min(A'*A)/20}
  plant:
    state: {x: {shape: 2, start: "[1; 0]"}, c: {shape: 2, start: 0}, d: {shape: 1, start: 0}}
    flow: {x: "A*x - 0.1*x(1)^3*[0; 1]", c: A*c}
    at: {sample: {d: 1}}
  claims:
    exact: {below: "norm(c) + 1", bound: 2}
    ahead: {below: "norm(expm(A*sample.left)*x)", bound: 1.2}
    decays: {below: norm(x)*exp(rate*t), bound: 4}
    spent: {cost: {flow: x'*x/20}, below: x'*x/(1 - d)}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"},
    {"balls that come to rest", R"yaml(problem: p
method:
  method: m
  events:
    hit:  {falls: "x(1)"}
    land: {when: y <= 0}
  plant:
    state: {x: {shape: 2, start: "[4; 2]"}, y: {shape: 2, start: "[1; 0]"}}
    flow: {x: "[x(2); -9.81]", y: "[y(2); -9.81 - 0.1*y(2)]"}
    at: {hit: {x: "[0; -0.8*x(2)]"}, land: {y: "[0; -0.3*y(2)]"}}
  claims:
    high: {below: "x(1)", bound: 3}
    energy: {nonincreasing: "9.81*x(1) + x(2)^2/2", tolerance: 1e-9}
    rests: {shrinks: norm(x), to: 1e-5}
    both: {below: "x(1) + y(1)", bound: 4}
campaign: {runs: 96, horizon: 20, initial: {x: {box: ["[1; -1]", "[4; 1]"]}}}
)yaml"},
    // Where it touches the ground its height is 0 up to rounding, of either sign.
    {"a ball that an observer sees where it touches the ground", R"yaml(problem: p
method:
  method: m
  events: {hit: {when: x(1) <= 0 and x(2) <= 0}}
  plant:
    state: {x: {shape: 2, start: "[4; 2]"}}
    output: {y: x(1)}
    flow: {x: "[x(2); -9.81]"}
    at: {hit: {x: "[-x(1); -0.8*x(2)]"}}
  observer:
    state: {xh: {shape: 2, start: 0}}
    flow: {xh: "[xh(2); -9.81]"}
    at: {hit: {xh: "[-xh(1); -0.8*xh(2)] - [-1; -0.1487]*(xh(1) - y)"}}
  claims:
    converges: {shrinks: norm(x - xh), to: 1e-7}
    high: {below: "x(1)", bound: 3.5}
    far: {above: "xh(1)", bound: -4, over: hit}
campaign: {runs: 96, horizon: 20, initial: {x: {box: ["[2; -2]", "[4; 2]"]}, xh: {box: [-3, 3]}}}
)yaml"},
    {"a ball that comes to rest", R"yaml(problem: p
method:
  method: m
  events: {hit: {falls: "x(1)"}}
  plant:
    state: {x: {shape: 2, start: "[4; 2]"}}
    flow: {x: "[x(2); -9.81]"}
    at: {hit: {x: "[0; -0.8*x(2)]"}}
  claims:
    high: {below: "x(1)", bound: 3}
    energy: {nonincreasing: "9.81*x(1) + x(2)^2/2", tolerance: 1e-9}
    rests: {shrinks: norm(x), to: 1e-5}
campaign: {runs: 96, horizon: 20, initial: {x: {box: ["[1; -1]", "[4; 1]"]}}}
)yaml"},
    // M has the eigenvalues 1 + |x(1)| and 1 - |x(1)|, which are equal where x(1) is 0.
    {"eigenvalues, norms and determinants of matrices", R"yaml(problem: p
method:
  method: m
  plant:
    state: {x: {shape: 2, start: 0}, P: {shape: symmetric 3, start: I}}
    flow: {x: "[x(2); -x(1)]", P: "He([0, 1, 0; 0, 0, 1; -1, -2, -2]*P) + [0.1, 0, 0; 0, 0.2, 0; 0, 0, x(1)^2]"}
  signals: {M: "[1 + x(1), 0; 0, 1 - x(1)]", N: "[1, x(1); x(2), 0; 0, x(1)]"}
  claims:
    least: {above: lambda_min(P), bound: 0.1}
    low: {above: lambda_min(M), bound: 0.5}
    high: {below: lambda_max(M), bound: 1.5}
    size: {below: norm(N), bound: 1.6}
    volume: {above: det(P), bound: 0.01}
    inverse: {below: "norm(pinv(N)(1, :))", bound: 1.2}
    shrinks: {shrinks: norm(P), to: 0.9}
campaign: {runs: 96, horizon: 6, initial: {x: {box: [-1, 1]}}}
)yaml"}};

}  // namespace gainsmith::verify
