// Linear systems for the tests of this room.
#pragma once

#include <random>

#include "response/state_space.h"

namespace gainsmith::response {

inline Matrix random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index cols) {
  std::normal_distribution<double> element;
  Matrix result(rows, cols);
  for (double& x : result.reshaped()) x = element(random);
  return result;
}

/// With all poles left of -0.1, or within 0.95 where it is sampled.
inline StateSpace random_system(std::mt19937& random, Eigen::Index n, Eigen::Index m,
                                Eigen::Index p, double step = 0) {
  StateSpace system{random_matrix(random, n, n), random_matrix(random, n, m),
                    random_matrix(random, p, n), 0.3 * random_matrix(random, p, m), step};
  const Matrix all = poles(system);
  if (step > 0) {
    system.A *= 0.95 / all.rowwise().norm().maxCoeff();
  } else {
    system.A -= (all.col(0).maxCoeff() + 0.1) * Matrix::Identity(n, n);
  }
  return system;
}

/// w^2/(s^2 + 2 d w s + w^2).
inline StateSpace oscillator(double w, double damping) {
  return {Matrix{{-2 * damping * w, -w * w}, {1, 0}}, Matrix{{1}, {0}}, Matrix{{0, w * w}},
          Matrix{{0}}, 0};
}

}  // namespace gainsmith::response
