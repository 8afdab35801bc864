// Whether a filter's covariance fits its errors (Bar-Shalom, Li and Kirubarajan, Estimation with
// Applications to Tracking and Navigation, 5.4).
//
//   NEES   e' P^-1 e of an error e of n elements and its covariance P, at one moment
//   NIS    r' S^-1 r of an innovation r and its covariance S, at each sample of an event
//
// Of a consistent filter of a linear system with Gaussian noise each is chi-square distributed with
// n degrees of freedom. They are independent from run to run; innovations are also white within
// a run. So the sum of K of them is chi-square distributed with n K degrees, and their mean lies
// in
//
//   [chi2^-1(a/2; n K) / K, chi2^-1(1 - a/2; n K) / K]
//
// with the probability 1 - a. A larger mean says that errors are larger than P knows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "claims/run_figures.h"
#include "statistics/exact_sum.h"

namespace gainsmith::statistics {

/// NEES or NIS of some runs. Sums are exact, so their order and grouping does not matter.
struct SquaredErrors {
  std::int64_t elements = 0;  ///< n
  std::uint64_t count = 0;    ///< K
  ExactSum sum{};
  std::uint64_t improper = 0;  ///< squares that are negative, infinite or no numbers

  /// Those of one run.
  void add(const claims::Squares& run);
  void add(const SquaredErrors& more);
  bool operator==(const SquaredErrors&) const = default;
};

/// Undecided where some P is not positive definite.
enum class Fit { consistent, too_optimistic, too_pessimistic, undecided };
/// "consistent", "too optimistic", "too pessimistic", "undecided".
std::string to_string(Fit fit);

struct Consistency {
  Fit fit = Fit::undecided;
  double probability = 0;
  std::optional<double> mean;  ///< of the squares; n is expected
  /// Where the mean of a consistent filter lies with that probability.
  std::optional<double> low, high;
};

/// Without squares nothing but undecided. The probability in (0, 1).
Consistency consistency_of(const SquaredErrors& errors, double probability);

}  // namespace gainsmith::statistics
