// Shorthand of the tests of designs: a method inline, its data, the gains; random data.
#pragma once

#include <cmath>
#include <string>

#include "base/random.h"
#include "design/synthesize.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {

/// Of the keys of a method, two columns in, and those of a problem.
inline model::Gains solve(const std::string& method, const std::string& data = "") {
  const tests::YamlProblem yaml("problem: p\nmethod:\n  method: m\n" + method + data);
  return synthesize(yaml.instance, {});
}

/// Of the whole text of a problem.
inline model::Gains synthesized(const std::string& text) {
  const tests::YamlProblem yaml(text);
  return synthesize(yaml.instance, {});
}

/// Elements in 64ths, in [-1, 1].
inline numbers::Matrix random_symmetric(RandomStream& random, int n) {
  numbers::Matrix C(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) C(i, j) = C(j, i) = std::round(128 * random.uniform() - 64) / 64;
  return C;
}

}  // namespace gainsmith::design
