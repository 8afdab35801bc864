// Small problems must not pay for the heap: no allocation from the second iteration to the last.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <vector>

#include "sdp/solver.h"
#include "support/sdp_catalogue.h"

#if defined(__SANITIZE_ADDRESS__)
#define GAINSMITH_COUNTS_ALLOCATIONS 0
#else
#define GAINSMITH_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<long> allocations = 0;
}

#if GAINSMITH_COUNTS_ALLOCATIONS
// Everything that allocates in this program ends here: operator new and Eigen call malloc.
extern "C" {
void* __libc_malloc(std::size_t size);
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
}
#endif

namespace gainsmith::sdp {
namespace {

TEST(Allocation, NoneInsideTheIteration) {
  if (!GAINSMITH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns the heap";
  ASSERT_GT(allocations, 0);
  for (const auto& known : testing::sdp_catalogue()) {
    ASSERT_LT(known.problem.m(), 50);
    std::vector<long> counts;
    counts.reserve(1000);
    Options options;
    options.precision = "double";
    options.progress = [&](const Progress& line) {
      if (line.iteration == 0) counts.clear();
      counts.push_back(allocations);
    };
    solve(known.problem, options);
    ASSERT_FALSE(counts.empty() && known.answer == testing::CatalogueProblem::Answer::optimum);
    for (std::size_t k = 2; k < counts.size(); ++k)
      EXPECT_EQ(counts[k], counts[k - 1]) << known.name << ", iteration " << k;
  }
}

}  // namespace
}  // namespace gainsmith::sdp
