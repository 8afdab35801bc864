// Which runs of a campaign: ranges that neither overlap nor touch, in order.
#pragma once

#include <cstdint>
#include <vector>

namespace gainsmith::statistics {

/// Runs first, first + 1, ..., last - 1.
struct RunRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;

  std::uint64_t count() const { return last > first ? last - first : 0; }
  bool operator==(const RunRange&) const = default;
};

class RunSet {
 public:
  RunSet() = default;

  /// Adds runs. The runs of them that were there already: none, or the first range of them; then
  /// nothing is added.
  RunRange add(RunRange range);

  const std::vector<RunRange>& ranges() const { return ranges_; }
  std::uint64_t count() const;
  /// Those of `whole` that are not here.
  std::vector<RunRange> missing_in(RunRange whole) const;

  bool operator==(const RunSet&) const = default;

 private:
  std::vector<RunRange> ranges_;
};

/// Part `index` of `of` parts of `runs` runs, 1 <= index <= of. Parts differ by a run at most where
/// there are few runs for each, otherwise by a chunk of 4,096, so that runs are made many at once.
RunRange shard_of(std::uint64_t runs, std::uint64_t index, std::uint64_t of);

}  // namespace gainsmith::statistics
