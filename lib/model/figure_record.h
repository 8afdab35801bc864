// Figures over the runs of a campaign, as `campaign.json` and `simulate --compare --json` keep them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gainsmith::model {

struct QuantileRecord {
  double probability = 0;
  std::optional<double> value;
  std::optional<double> low, high;  ///< of its confidence interval; none: there are too few runs
};

/// Of `nees` and `nis`.
struct ConsistencyRecord {
  std::string fit;  ///< "consistent", "too optimistic", "too pessimistic", "undecided"
  std::uint64_t squares = 0;
  std::uint64_t improper = 0;  ///< more, that are negative, infinite or no numbers
  std::optional<double> mean;  ///< of the squares
  std::uint64_t expected = 0;
  std::optional<double> low, high;  ///< where the mean of a consistent filter lies
  double probability = 0;           ///< ... with this probability
};

/// A figure of one observer, or of none. Values may be infinite.
struct FigureRecord {
  std::string figure;
  std::string observer;
  std::uint64_t runs = 0;     ///< that have such a number; of these is what follows
  std::uint64_t without = 0;  ///< those that have none
  std::uint64_t unknown = 0;  ///< those of which it is not known ...
  std::string why;            ///< ... and why, of the first one
  double error = 0;           ///< the largest of the numbers
  std::optional<double> least, largest;
  std::uint64_t least_run = 0, largest_run = 0;
  double least_error = 0, largest_error = 0;
  std::vector<QuantileRecord> quantiles;
  double resolution = 0;  ///< by which part of itself the value of a quantile may be off
  std::optional<ConsistencyRecord> consistency;
};

struct FiguresRecord {
  std::uint64_t runs = 0;
  std::uint64_t asked = 0;  ///< more than `runs` after an interruption
  std::uint64_t seed = 0;
  std::optional<double> confidence;  ///< of the intervals; none: nothing is drawn
  std::vector<FigureRecord> figures;
};

}  // namespace gainsmith::model
