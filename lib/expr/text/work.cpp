#include "expr/text/work.h"

#include <atomic>

namespace gainsmith::expr {

namespace {

std::atomic<std::uint64_t> parsed_texts = 0;
std::atomic<std::uint64_t> bound = 0;
std::atomic<std::uint64_t> problems = 0;
std::atomic<std::uint64_t> designs = 0;

void count(std::atomic<std::uint64_t>& counter) { counter.fetch_add(1, std::memory_order_relaxed); }

std::uint64_t value(const std::atomic<std::uint64_t>& counter) {
  return counter.load(std::memory_order_relaxed);
}

}  // namespace

Work work_done() { return {value(parsed_texts), value(bound), value(problems), value(designs)}; }

void count_parsed() { count(parsed_texts); }
void count_bound() { count(bound); }
void count_problem() { count(problems); }
void count_design() { count(designs); }

}  // namespace gainsmith::expr
