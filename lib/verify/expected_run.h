// Figures of runs of dynamics with events: those expected of the first run, and those that are
// compared.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/gains.h"
#include "model/instance.h"

namespace gainsmith::verify {

struct FoundFigure {
  std::string title;
  std::string observer;         ///< empty: of none
  std::optional<double> value;  ///< none: the run has no such number
  /// How far it is from that of a run integrated to a hundredth of the tolerance.
  double difference = 0;
};

struct Comparison {
  std::vector<FoundFigure> figures;
  std::string early;  ///< why the run ended before its horizon; empty where it did not, or by zeno
};

/// The figures under `compare`, of each of these runs of the seed.
std::vector<Comparison> compared_figures(const model::Instance& instance, const model::Gains& gains,
                                         std::uint64_t seed,
                                         const std::vector<std::uint64_t>& runs);

struct RunDifferences {
  std::vector<std::string> different;  ///< place: figure: expected ..., found ...
  std::vector<std::string> undecided;  ///< those whose digits do not decide
  std::size_t figures = 0;             ///< that were expected
};

/// What is expected of the first run (number 0) and is not found there.
RunDifferences run_differences(const model::Instance& instance, const model::Gains& gains);

}  // namespace gainsmith::verify
