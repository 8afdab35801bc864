// Runs of a linear system, kLanes at once (linear/system.h): those of one law together.
//
// Behind a jump the state is x = B z. A flow and the jump at its end are z+ = M(s) z, with M
// polynomials of the length s. Costs and claims are quadratic forms of z. Errors of z and of forms
// are bounded (linear/system.h), so verdicts rest on bounds; a pack of steps has estimates instead.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "linear/system.h"
#include "packs/pack_runner.h"

namespace gainsmith::packs {

class LinearLanes;

class LinearRunner {
 public:
  /// One for each thread. The system must outlive it.
  explicit LinearRunner(const linear::LinearSystem& system);
  LinearRunner(LinearRunner&&) noexcept;
  LinearRunner& operator=(LinearRunner&&) noexcept;
  ~LinearRunner();

  /// Runs first, ..., last - 1, drawn or as the scenario gives them. Stopped (base/stop.h) when it
  /// is asked to stop.
  std::vector<PackVerdict> run(std::uint64_t seed, std::uint64_t first, std::uint64_t last);

 private:
  std::unique_ptr<LinearLanes> lanes_;
};

}  // namespace gainsmith::packs
