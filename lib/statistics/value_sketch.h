// A multiset of numbers in bounded memory: order statistics of figures over the runs of a campaign.
//
// Doubles are ordered like whole numbers: key(x) are the bits of x, those behind the sign inverted
// where x < 0. A bucket of level s holds the numbers with the same floor(key / 2^s), and how many
// there are. Level 0 keeps every number; on level s a bucket of normal numbers is narrower than
// 2^(s - 52) of its end next to 0. The sketch is at the least level on which it has no more
// buckets than its capacity. That level depends on the numbers alone. So sketches of the same
// numbers are equal, whatever the order and grouping in which numbers and sketches were added: by
// threads, blocks of runs or machines.
//
// It is exact as long as no more different numbers than the capacity were added. With the usual
// capacity it never exceeds level 52, an octave a bucket; a million numbers within three decades
// are kept to 2^-10 or better. Infinite numbers are numbers here; NaN is not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gainsmith::statistics {

/// Between which numbers one lies.
struct Enclosure {
  double low = 0;
  double high = 0;

  bool operator==(const Enclosure&) const = default;
  double middle() const;
};

class ValueSketch {
 public:
  static constexpr std::size_t kUsual = 8192;  ///< buckets, of 16 bytes

  /// At least 4 buckets.
  explicit ValueSketch(std::size_t capacity = kUsual);

  void add(const std::vector<double>& values);
  /// A sketch of the same capacity.
  void add(const ValueSketch& more);

  std::uint64_t count() const { return count_; }
  bool exact() const { return level_ == 0; }
  /// By which part of itself the middle of an enclosure may be off; 0 where it is exact.
  double resolution() const;

  /// X_(rank), the number of this rank in ascending order, 1 <= rank <= count. The enclosures of
  /// the least and of the largest number are themselves.
  Enclosure ranked(std::uint64_t rank) const;

  struct Part {
    Enclosure values;
    std::uint64_t count = 0;
  };
  /// All buckets, in ascending order.
  std::vector<Part> parts() const;

  /// All that a sketch of the usual capacity is, for files.
  struct Contents {
    int level = 0;
    std::uint64_t count = 0;
    double least = 0, largest = 0;
    std::vector<std::int64_t> at;       ///< of the buckets ...
    std::vector<std::uint64_t> counts;  ///< ... and how many numbers there are
  };
  Contents contents() const;
  static ValueSketch of(const Contents& contents);

  bool operator==(const ValueSketch&) const = default;

 private:
  struct Bucket {
    std::int64_t at = 0;
    std::uint64_t count = 0;

    bool operator==(const Bucket&) const = default;
  };

  void merge(std::vector<Bucket> more, int level);
  /// To a higher level: buckets with the same floor(at / 2^(level - level_)) become one.
  void coarsen(int level);
  Enclosure values_of(const Bucket& bucket) const;

  std::size_t capacity_;
  int level_ = 0;
  std::uint64_t count_ = 0;
  double least_, largest_;
  std::vector<Bucket> buckets_;  ///< in ascending order
};

}  // namespace gainsmith::statistics
