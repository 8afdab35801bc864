#include "base/parallel.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <numeric>
#include <set>
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

/// Opens for all when `expected` threads are there.
class Meeting {
 public:
  explicit Meeting(std::size_t expected) : expected_(expected) {}

  /// Until the others come, or the test is ended.
  void wait() {
    std::unique_lock lock(mutex_);
    here_.insert(std::this_thread::get_id());
    changed_.notify_all();
    changed_.wait(lock, [&] { return here_.size() >= expected_; });
  }

 private:
  const std::size_t expected_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::thread::id> here_;
};

/// Counts the threads that are inside at a time, and all that have ever been.
class Crowd {
 public:
  void enter() {
    const std::lock_guard lock(mutex_);
    ids_.insert(std::this_thread::get_id());
    most_ = std::max(most_, ++inside_);
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --inside_;
  }
  /// A stay that is long enough for others to come.
  void visit() {
    enter();
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    leave();
  }
  int most() const { return most_; }
  std::size_t ids() const { return ids_.size(); }

 private:
  std::mutex mutex_;
  std::set<std::thread::id> ids_;
  int inside_ = 0;
  int most_ = 0;
};

/// Loops `depth` deep whose lengths and loads differ; the sum depends on every item once.
std::uint64_t sum_of_tree(unsigned depth, std::uint64_t label, unsigned threads) {
  if (depth == 0) {
    std::uint64_t hash = label;
    const std::uint64_t load = label % 7 == 0 ? 3000 : 10;
    for (std::uint64_t k = 0; k < load; ++k)
      hash = hash * 6364136223846793005U + 1442695040888963407U;
    return hash;
  }
  std::vector<std::uint64_t> parts(label % 5 + (depth > 1 ? 1 : 0));
  parallel_for(parts.size(), threads, [&](std::size_t i) {
    parts[i] = (i + 1) * sum_of_tree(depth - 1, 31 * label + i + 1, threads);
  });
  return std::accumulate(parts.begin(), parts.end(), label);
}

TEST(NestedLoops, GiveTheSameForAnyNumberOfThreads) {
  for (const unsigned depth : {2U, 3U, 5U}) {
    for (std::uint64_t label = 1; label < 30; ++label) {
      const std::uint64_t expected = sum_of_tree(depth, label, 1);
      for (const unsigned threads : {0U, 2U, 3U, 8U})
        ASSERT_EQ(sum_of_tree(depth, label, threads), expected)
            << depth << " deep, label " << label << ", " << threads << " threads";
    }
  }
}

TEST(NestedLoops, OneThreadOutsideIsOneThreadEverywhere) {
  const auto caller = std::this_thread::get_id();
  std::vector<std::size_t> order;
  parallel_for(4, 1, [&](std::size_t i) {
    parallel_for(3, 8, [&](std::size_t j) {
      parallel_for(2, 0, [&](std::size_t k) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        order.push_back((i * 3 + j) * 2 + k);
      });
    });
  });
  ASSERT_EQ(order.size(), 24U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(NestedLoops, OneThreadInsideRunsInOrderOnTheThreadOfItsItem) {
  parallel_for(8, 4, [](std::size_t) {
    const auto caller = std::this_thread::get_id();
    std::vector<std::size_t> order;
    parallel_for(20, 1, [&](std::size_t i) {
      parallel_for(3, 4, [&](std::size_t j) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        order.push_back(3 * i + j);
      });
    });
    EXPECT_TRUE(order.size() == 60 && std::is_sorted(order.begin(), order.end()));
  });
}

TEST(NestedLoops, TheOnlyItemSharesItsInnerLoop) {
  Meeting all(3);
  parallel_for(1, 3, [&](std::size_t) {
    parallel_for(1, 3, [&](std::size_t) { parallel_for(3, 3, [&](std::size_t) { all.wait(); }); });
  });
}

/// The first item is done at once; its thread must go to the inner loop of the second.
TEST(NestedLoops, AWorkerWithoutItemsEntersTheInnerLoopOfAnother) {
  for (const std::size_t busy : {0U, 1U}) {
    Meeting outside(2);
    Meeting inside(2);
    parallel_for(2, 2, [&](std::size_t i) {
      outside.wait();
      if (i == busy) parallel_for(2, 2, [&](std::size_t) { inside.wait(); });
    });
  }
}

/// Both threads are in the loop. The caller runs out of items first, in one of two rounds, and has
/// to help with the loop within the other's item.
TEST(NestedLoops, WhoWaitsHelpsWithinItsOwnLoop) {
  for (const bool on_caller : {false, true}) {
    const auto caller = std::this_thread::get_id();
    Meeting outside(2);
    Meeting inside(2);
    parallel_for(2, 2, [&](std::size_t) {
      outside.wait();
      if ((std::this_thread::get_id() == caller) == on_caller)
        parallel_for(2, 2, [&](std::size_t) { inside.wait(); });
    });
  }
}

/// Who waits for an inner loop holds a lock that items further out take: it must not run those.
TEST(NestedLoops, ALockMayBeHeldOverAnInnerLoop) {
  std::mutex mutex;
  int sum = 0;
  parallel_for(16, 4, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    std::vector<int> parts(8);
    parallel_for(parts.size(), 4, [&](std::size_t j) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      parts[j] = 1;
    });
    sum += std::accumulate(parts.begin(), parts.end(), 0);
  });
  EXPECT_EQ(sum, 16 * 8);
}

TEST(NestedLoops, NeverMoreThreadsThanTheOutermostAsksFor) {
  for (const unsigned threads : {2U, 3U}) {
    Crowd crowd;
    Meeting first(2);
    parallel_for(6, threads, [&](std::size_t i) {
      if (i < 2) first.wait();
      crowd.visit();
      parallel_for(5, 8, [&](std::size_t) {
        crowd.visit();
        parallel_for(4, 0, [&](std::size_t) { crowd.visit(); });
      });
    });
    EXPECT_LE(crowd.most(), static_cast<int>(threads));
    EXPECT_LE(crowd.ids(), threads);
    EXPECT_GE(crowd.ids(), 2U);
  }
}

TEST(NestedLoops, AnInnerLoopAndAllWithinItKeepToItsThreads) {
  Crowd around;
  std::array<Crowd, 3> crowds;
  parallel_for(crowds.size(), 6, [&](std::size_t i) {
    parallel_for(6, 2, [&](std::size_t) {
      parallel_for(6, 6, [&](std::size_t) {
        around.enter();
        crowds[i].visit();
        around.leave();
      });
    });
  });
  for (const Crowd& crowd : crowds) EXPECT_LE(crowd.most(), 2);
  EXPECT_LE(around.most(), 6);
}

/// Messages of inner loops, as the loop around them sees them.
TEST(NestedLoops, AFailureOfAnInnerLoopIsAFailureOfItsItem) {
  for (const unsigned threads : {1U, 2U, 4U, 8U}) {
    std::string message;
    try {
      parallel_for(50, threads, [&](std::size_t i) {
        parallel_for(9, threads, [&](std::size_t j) {
          parallel_for(3, threads, [&](std::size_t k) {
            if (i == 11 && j == 4) std::this_thread::sleep_for(std::chrono::milliseconds(2));
            if (i >= 11 && j >= 4 && k >= 1)
              throw std::runtime_error(fmt::format("{} {} {}", i, j, k));
          });
        });
      });
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
    EXPECT_EQ(message, "11 4 1") << threads;
  }
}

TEST(NestedLoops, AFailureThatIsCaughtStopsOnlyItsLoop) {
  std::vector<std::string> messages(40);
  std::atomic<int> after = 0;
  parallel_for(messages.size(), 4, [&](std::size_t i) {
    try {
      parallel_for(10, 4, [&](std::size_t j) {
        if (j >= i % 10) throw std::runtime_error(std::to_string(j));
      });
    } catch (const std::runtime_error& error) {
      messages[i] = error.what();
    }
    parallel_for(3, 4, [&](std::size_t) { ++after; });
  });
  for (std::size_t i = 0; i < messages.size(); ++i) EXPECT_EQ(messages[i], std::to_string(i % 10));
  EXPECT_EQ(after, 3 * 40);
}

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

TEST(NestedLoops, NoThreadIsLeft) {
  if (!std::filesystem::exists("/proc/self/task")) GTEST_SKIP() << "no /proc";
  parallel_for(2, 2, [](std::size_t) {});  // the sanitizers start a thread of their own
  const std::ptrdiff_t before = threads_of_this_process();
  sum_of_tree(3, 9, 8);
  EXPECT_THROW(parallel_for(9, 8, [](std::size_t) { throw std::runtime_error("stop"); }),
               std::runtime_error);
  // The system may list a thread for a moment after it has been joined.
  while (threads_of_this_process() > before) std::this_thread::yield();
  EXPECT_EQ(threads_of_this_process(), before);
}

TEST(ThreadCount, ZeroStandsForTheCoresThatMayBeUsed) {
  EXPECT_EQ(thread_count(3), 3U);
  EXPECT_GE(thread_count(0), 1U);
  EXPECT_LE(thread_count(0), std::max(1U, std::thread::hardware_concurrency()));
}

TEST(ThreadCount, FollowsTheAffinity) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  int core = 0;
  while (!CPU_ISSET(core, &before)) ++core;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(usable_cores(), 1U);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
  EXPECT_LE(usable_cores(), static_cast<unsigned>(CPU_COUNT(&before)));
}

}  // namespace
}  // namespace gainsmith
