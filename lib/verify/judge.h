// The verdict on one run: in double, and in 31 digits where double does not decide.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "verify/setup.h"

namespace gainsmith::verify {

struct RunVerdict {
  Judgement judgement = Judgement::held;
  std::vector<Finding> findings;  ///< of the claims that are stated, in order
  hybrid::Termination termination = hybrid::Termination::horizon;
  std::string message;     ///< why it ended, when a jump map had no value
  bool repeated = false;   ///< in 31 digits
  bool confirmed = false;  ///< violated in 31 digits

  bool unfinished() const { return termination != hybrid::Termination::horizon; }
};

/// Judges run after run; one for each thread. The setup must outlive it.
class Judge {
 public:
  explicit Judge(const Setup& setup);

  /// What double decides is decided; a run with a claim that it does not decide, or that does not
  /// reach the horizon, is repeated in 31 digits. Of a run that does not end in 31 digits with half
  /// of its last state certain, the end is undecided.
  RunVerdict operator()(std::uint64_t seed, std::uint64_t run);

  /// The run in 31 digits.
  RunVerdict confirm(std::uint64_t seed, std::uint64_t run);

  /// In double, until the next call.
  const hybrid::Track<double>& track(std::uint64_t seed, std::uint64_t run) {
    return narrow_.run(seed, run);
  }
  std::vector<ClaimCheck<double>>& checks() { return checks_; }

 private:
  hybrid::BoundedSimulator<double> narrow_;
  hybrid::BoundedSimulator<DoubleDouble> wide_;
  std::vector<ClaimCheck<double>> checks_;
  std::vector<ClaimCheck<DoubleDouble>> wide_checks_;
};

}  // namespace gainsmith::verify
