// Sums over many runs, in blocks on threads, in memory that does not grow.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "base/stop.h"

namespace gainsmith::statistics {

/// For k = 0, ..., count - 1, in blocks: `make()` a worker for each block, `work(worker, k)` for its
/// items, then `add(worker)` for the blocks in order. After a stop (base/stop.h) the items before
/// the first that was not done are added.
template <class Make, class Work, class Add>
void sum_over_runs(std::uint64_t count, unsigned threads, const Make& make, const Work& work,
                   const Add& add) {
  constexpr std::uint64_t kBlock = 64;
  using Worker = decltype(make());
  struct Block {
    std::unique_ptr<Worker> worker;
    bool whole = false;
  };
  const std::uint64_t at_once = std::uint64_t{16} * thread_count(threads);
  for (std::uint64_t from = 0; from < count;) {
    const std::uint64_t to = std::min(count, from + at_once * kBlock);
    std::vector<Block> blocks(static_cast<std::size_t>((to - from + kBlock - 1) / kBlock));
    try {
      parallel_for(blocks.size(), threads, [&](std::size_t b) {
        const std::uint64_t first = from + b * kBlock, last = std::min(to, first + kBlock);
        blocks[b].worker = std::make_unique<Worker>(make());
        try {
          for (std::uint64_t k = first; k < last; ++k) {
            check_stop();
            work(*blocks[b].worker, k);
          }
          blocks[b].whole = true;
        } catch (const Stopped&) {
          // The items that are done count.
        }
      });
    } catch (const Stopped&) {
      // Blocks that were not begun have no worker.
    }
    const Concluding concluding;
    for (Block& block : blocks) {
      if (block.worker) add(*block.worker);
      if (!block.whole) return;
    }
    from = to;
  }
}

}  // namespace gainsmith::statistics
