#include "expr/work.h"

#include <atomic>

namespace gainsmith::expr {

namespace {

std::atomic<std::uint64_t> parsed = 0;
std::atomic<std::uint64_t> bound = 0;

}  // namespace

Work work_done() {
  return {parsed.load(std::memory_order_relaxed), bound.load(std::memory_order_relaxed)};
}

void count_parsed() { parsed.fetch_add(1, std::memory_order_relaxed); }

void count_bound() { bound.fetch_add(1, std::memory_order_relaxed); }

}  // namespace gainsmith::expr
