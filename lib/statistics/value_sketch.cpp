#include "statistics/value_sketch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gainsmith::statistics {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kBehindSign = std::numeric_limits<std::int64_t>::max();

/// Its own inverse.
std::int64_t ordered(std::int64_t bits) { return bits < 0 ? bits ^ kBehindSign : bits; }

/// Of -0 that of 0.
std::int64_t key_of(double value) { return ordered(std::bit_cast<std::int64_t>(value + 0.0)); }

double value_of(std::int64_t key) { return std::bit_cast<double>(ordered(key)); }

/// Ascending buckets of which neighbours may be equal: those are one.
template <class Bucket>
void unite(std::vector<Bucket>& buckets) {
  std::size_t last = 0;
  for (std::size_t k = 1; k < buckets.size(); ++k) {
    if (buckets[k].at == buckets[last].at)
      buckets[last].count += buckets[k].count;
    else
      buckets[++last] = buckets[k];
  }
  if (!buckets.empty()) buckets.resize(last + 1);
}

}  // namespace

double Enclosure::middle() const { return low == high ? low : low / 2 + high / 2; }

ValueSketch::ValueSketch(std::size_t capacity)
    : capacity_(capacity), least_(kInfinity), largest_(-kInfinity) {
  if (capacity < 4) throw std::logic_error("a sketch of fewer than 4 buckets");
}

void ValueSketch::add(const std::vector<double>& values) {
  std::vector<Bucket> fresh;
  for (const double value : values) {
    if (std::isnan(value)) throw std::logic_error("a sketch of what is no number");
    least_ = std::min(least_, value + 0.0);
    largest_ = std::max(largest_, value + 0.0);
    fresh.push_back({key_of(value), 1});
  }
  std::sort(fresh.begin(), fresh.end(),
            [](const Bucket& a, const Bucket& b) { return a.at < b.at; });
  count_ += values.size();
  merge(std::move(fresh), 0);
}

void ValueSketch::add(const ValueSketch& more) {
  if (more.capacity_ != capacity_) throw std::logic_error("sketches of two capacities");
  least_ = std::min(least_, more.least_);
  largest_ = std::max(largest_, more.largest_);
  count_ += more.count_;
  merge(more.buckets_, more.level_);
}

void ValueSketch::merge(std::vector<Bucket> more, int level) {
  if (level > level_) coarsen(level);
  for (Bucket& bucket : more) bucket.at >>= level_ - level;
  const auto middle = static_cast<std::ptrdiff_t>(buckets_.size());
  buckets_.insert(buckets_.end(), more.begin(), more.end());
  std::inplace_merge(buckets_.begin(), buckets_.begin() + middle, buckets_.end(),
                     [](const Bucket& a, const Bucket& b) { return a.at < b.at; });
  unite(buckets_);
  while (buckets_.size() > capacity_) coarsen(level_ + 1);
}

void ValueSketch::coarsen(int level) {
  for (Bucket& bucket : buckets_) bucket.at >>= level - level_;
  level_ = level;
  unite(buckets_);
}

double ValueSketch::resolution() const { return exact() ? 0 : std::ldexp(1.0, level_ - 53); }

Enclosure ValueSketch::values_of(const Bucket& bucket) const {
  const auto width = std::int64_t{1} << level_;
  const std::int64_t first = bucket.at * width;
  // Where a bucket goes beyond all numbers, those that were added end it.
  const std::int64_t low = std::max(first, key_of(least_));
  const std::int64_t high = std::min(first + (width - 1), key_of(largest_));
  return {value_of(low), value_of(high)};
}

Enclosure ValueSketch::ranked(std::uint64_t rank) const {
  if (rank < 1 || rank > count_) throw std::logic_error("a rank that no number has");
  if (rank == 1) return {least_, least_};
  if (rank == count_) return {largest_, largest_};
  std::uint64_t seen = 0;
  for (const Bucket& bucket : buckets_)
    if ((seen += bucket.count) >= rank) return values_of(bucket);
  throw std::logic_error("buckets with too few numbers");
}

std::vector<ValueSketch::Part> ValueSketch::parts() const {
  std::vector<Part> all;
  all.reserve(buckets_.size());
  for (const Bucket& bucket : buckets_) all.push_back({values_of(bucket), bucket.count});
  return all;
}

ValueSketch::Contents ValueSketch::contents() const {
  Contents contents{level_, count_, least_, largest_, {}, {}};
  for (const Bucket& bucket : buckets_) {
    contents.at.push_back(bucket.at);
    contents.counts.push_back(bucket.count);
  }
  return contents;
}

ValueSketch ValueSketch::of(const Contents& contents) {
  ValueSketch sketch;
  sketch.level_ = contents.level;
  sketch.count_ = contents.count;
  sketch.least_ = contents.least;
  sketch.largest_ = contents.largest;
  for (std::size_t k = 0; k < contents.at.size(); ++k)
    sketch.buckets_.push_back({contents.at[k], contents.counts[k]});
  return sketch;
}

}  // namespace gainsmith::statistics
