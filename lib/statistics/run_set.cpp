#include "statistics/run_set.h"

#include <algorithm>

namespace gainsmith::statistics {

RunRange RunSet::add(RunRange range) {
  if (range.count() == 0) return {};
  // The first range that ends at or behind the beginning of the new one.
  const auto begin = std::lower_bound(
      ranges_.begin(), ranges_.end(), range.first,
      [](const RunRange& stretch, std::uint64_t first) { return stretch.last < first; });
  auto end = begin;
  for (; end != ranges_.end() && end->first <= range.last; ++end) {
    const RunRange both{std::max(end->first, range.first), std::min(end->last, range.last)};
    if (both.count() > 0) return both;
  }
  if (begin == end) {
    ranges_.insert(begin, range);
    return {};
  }
  begin->first = std::min(begin->first, range.first);
  begin->last = std::max((end - 1)->last, range.last);
  ranges_.erase(begin + 1, end);
  return {};
}

std::uint64_t RunSet::count() const {
  std::uint64_t count = 0;
  for (const RunRange& range : ranges_) count += range.count();
  return count;
}

std::vector<RunRange> RunSet::missing_in(RunRange whole) const {
  std::vector<RunRange> missing;
  std::uint64_t from = whole.first;
  for (const RunRange& range : ranges_) {
    if (range.last <= from) continue;
    if (range.first >= whole.last) break;
    if (range.first > from) missing.push_back({from, range.first});
    from = range.last;
  }
  if (from < whole.last) missing.push_back({from, whole.last});
  return missing;
}

RunRange shard_of(std::uint64_t runs, std::uint64_t index, std::uint64_t of) {
  constexpr std::uint64_t kChunk = 4096;
  constexpr std::uint64_t kManyChunks = 16;  // a shard: then they differ by few percent
  const std::uint64_t unit = runs / of >= kManyChunks * kChunk ? kChunk : 1;
  const std::uint64_t units = (runs + unit - 1) / unit;
  // floor(units k / of) without a product that may overflow.
  const auto begin = [&](std::uint64_t k) {
    return std::min(runs, unit * (units / of * k + units % of * k / of));
  };
  return {begin(index - 1), begin(index)};
}

}  // namespace gainsmith::statistics
