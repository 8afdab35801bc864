#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace gainsmith {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    for (const std::size_t count : {0UL, 1UL, 2UL, 1000UL}) {
      std::vector<std::atomic<int>> calls(count);
      parallel_for(count, threads, [&](std::size_t i) { ++calls[i]; });
      EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& n) { return n == 1; }))
          << count << " items on " << threads << " threads";
    }
  }
}

TEST(ParallelFor, OneThreadRunsInOrderOnTheCaller) {
  std::vector<std::size_t> order;
  const auto caller = std::this_thread::get_id();
  parallel_for(100, 1, [&](std::size_t i) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order.push_back(i);
  });
  ASSERT_EQ(order.size(), 100U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

std::string message_of_failure(unsigned threads) {
  try {
    parallel_for(200, threads, [&](std::size_t i) {
      // The lowest failure comes late, so that later ones are thrown first.
      if (i == 20) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (i >= 20) throw std::runtime_error(std::to_string(i));
    });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(ParallelFor, RethrowsTheFailureOfTheLowestIndex) {
  for (const unsigned threads : {1U, 2U, 4U, 8U})
    for (int repeat = 0; repeat < 5; ++repeat)
      EXPECT_EQ(message_of_failure(threads), "20") << threads;
}

TEST(ParallelFor, StopsHandingOutItemsAfterAFailure) {
  std::atomic<int> calls = 0;
  const auto body = [&](std::size_t) {
    ++calls;
    throw std::runtime_error("stop");
  };
  EXPECT_THROW(parallel_for(100000, 4, body), std::runtime_error);
  EXPECT_LE(calls, 4);
}

TEST(ThreadCount, ZeroStandsForTheCores) {
  EXPECT_EQ(thread_count(3), 3U);
  EXPECT_EQ(thread_count(0), std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace gainsmith
