// Threads of parallel_for: one team for each outermost loop, which inner loops share.
//
// Every open loop hands out its items by an atomic counter. A free thread enters the outermost loop
// with items and room. A caller that waits for others helps in loops within its own, and nowhere
// else.
#include "base/parallel.h"

#include <mpfr.h>

#if defined(__linux__)
#include <sched.h>
#endif

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/control_groups.h"
#include "base/stop.h"

namespace gainsmith {

namespace {

class Team;

/// One call of parallel_for. What is not const or atomic belongs to the team's mutex.
struct Loop {
  Loop(std::size_t items, unsigned threads, const std::function<void(std::size_t)>& what,
       Loop* around)
      : count(items),
        body(what),
        outer(around),
        depth(around ? around->depth + 1 : 0),
        limit(threads == 0 && around ? around->limit : thread_count(threads)),
        serial(limit == 1 || (around && around->serial)) {}

  bool has_items() const { return next < count; }

  /// Whether one more thread may enter, coming from `from`: a loop around this one, or from
  /// outside (null).
  bool has_room(const Loop* from) const {
    for (const Loop* loop = this; loop != from; loop = loop->outer)
      if (!loop || loop->inside == loop->limit) return false;
    return true;
  }

  const std::size_t count;
  const std::function<void(std::size_t)>& body;
  Loop* const outer;  ///< around this one, or null
  const unsigned depth;
  const unsigned limit;
  const bool serial;  ///< all on the caller
  Allowance* const allowance = AllowanceOfLoop::current();
  Team* team = nullptr;
  std::atomic<std::size_t> next = 0;

  unsigned inside = 1;   ///< threads at work in this loop or in loops within it, the caller first
  bool waiting = false;  ///< the caller, for the others to leave
  std::condition_variable called;  ///< the waiting caller
  std::size_t failed_index = 0;
  std::exception_ptr failure;
};

/// The loop whose item this thread runs.
thread_local Loop* running = nullptr;

/// The threads of an outermost loop. Whoever enters a loop calls the next one to what is left: so
/// nobody wakes, or is started, before there is something to do.
class Team {
 public:
  explicit Team(unsigned threads) : most_workers_(threads - 1) {}
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  ~Team() {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
    }
    called_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  void run(Loop& loop) {
    {
      const std::lock_guard lock(mutex_);
      open_.push_back(&loop);
      call_to(loop);
    }
    work(loop);
    std::unique_lock lock(mutex_);
    open_.erase(std::find(open_.begin(), open_.end(), &loop));
    while (loop.inside > 1) {
      if (Loop* inner = find(&loop)) {
        help(*inner, &loop, lock);
      } else {
        loop.waiting = true;
        loop.called.wait(lock, [&] { return !loop.waiting; });
      }
    }
  }

 private:
  void serve() {
    std::unique_lock lock(mutex_);
    while (!closing_) {
      if (Loop* loop = find(nullptr)) {
        help(*loop, nullptr, lock);
      } else {
        ++idle_;
        called_.wait(lock, [&] { return calls_ > 0 || closing_; });
        if (calls_ > 0) --calls_;
      }
    }
    ::mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE);  // the constants that it keeps for each thread
  }

  /// The outermost open loop, within `from` when it is given, that has items and room.
  Loop* find(const Loop* from) const {
    Loop* found = nullptr;
    for (Loop* loop : open_)
      if (loop->has_items() && (!found || loop->depth < found->depth) && loop->has_room(from))
        found = loop;
    return found;
  }

  /// Works in a loop, coming from `from`.
  void help(Loop& loop, const Loop* from, std::unique_lock<std::mutex>& lock) {
    for (Loop* entered = &loop; entered != from; entered = entered->outer) ++entered->inside;
    for (Loop* open : open_)
      if (open->has_items() && call_to(*open)) break;
    lock.unlock();
    work(loop);
    lock.lock();
    for (Loop* left = &loop; left != from; left = left->outer)
      if (--left->inside == 1) wake(*left);
  }

  /// Takes items until there are none.
  void work(Loop& loop) {
    Loop* const before = std::exchange(running, &loop);
    const AllowanceOfLoop here(loop.allowance);
    for (std::size_t i = loop.next++; i < loop.count; i = loop.next++) {
      try {
        check_stop();
        loop.body(i);
      } catch (...) {
        loop.next = loop.count;
        const std::lock_guard lock(mutex_);
        if (!loop.failure || i < loop.failed_index) {
          loop.failed_index = i;
          loop.failure = std::current_exception();
        }
      }
    }
    running = before;
  }

  /// Makes one thread search for work that may enter this loop; whether there is one.
  bool call_to(const Loop& loop) {
    for (Loop* outer = loop.outer; outer; outer = outer->outer)
      if (outer->waiting && loop.has_room(outer)) return wake(*outer);
    if (!loop.has_room(nullptr)) return false;
    if (idle_ > 0) {
      --idle_;
      ++calls_;
      called_.notify_one();
      return true;
    }
    return workers_.size() < most_workers_ && start();
  }

  static bool wake(Loop& loop) {
    if (!std::exchange(loop.waiting, false)) return false;
    loop.called.notify_one();
    return true;
  }

  /// Where the system gives no more threads, those that are there do the work.
  bool start() {
    try {
      workers_.emplace_back([this] { serve(); });
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }

  const std::size_t most_workers_;
  std::mutex mutex_;
  std::vector<std::thread> workers_;
  std::vector<Loop*> open_;
  std::condition_variable called_;  ///< the idle workers
  unsigned idle_ = 0;               ///< workers that wait and are not called
  unsigned calls_ = 0;              ///< that no worker has heard yet
  bool closing_ = false;
};

/// Puts back what `running` was, also after an exception.
class Running {
 public:
  explicit Running(Loop& loop) : before_(std::exchange(running, &loop)) {}
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() { running = before_; }

 private:
  Loop* before_;
};

void run(Loop& loop) {
  if (loop.serial || loop.count <= 1) {
    const Running here(loop);
    for (std::size_t i = 0; i < loop.count; ++i) {
      check_stop();
      loop.body(i);
    }
    return;
  }
  loop.team->run(loop);
  if (loop.failure) std::rethrow_exception(loop.failure);
}

/// On which the process may run; 0 where that is not known.
unsigned allowed_cores() {
#if defined(__linux__)
  constexpr int kMost = 1 << 16;
  cpu_set_t* const set = CPU_ALLOC(kMost);
  if (set == nullptr) return 0;
  const std::size_t size = CPU_ALLOC_SIZE(kMost);
  const int count = ::sched_getaffinity(0, size, set) == 0 ? CPU_COUNT_S(size, set) : 0;
  CPU_FREE(set);
  return static_cast<unsigned>(count);
#else
  return 0;
#endif
}

}  // namespace

unsigned usable_cores() {
  const unsigned allowed = allowed_cores();
  const unsigned most = allowed > 0 ? allowed : std::max(1U, std::thread::hardware_concurrency());
  const double share = std::ceil(least_of_groups("", "cpu.max"));
  return share < most ? std::max(1U, static_cast<unsigned>(share)) : most;
}

unsigned thread_count(unsigned threads) {
  static const unsigned cores = usable_cores();
  return threads > 0 ? threads : cores;
}

void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& body) {
  Loop loop(count, threads, body, running);
  if (loop.serial) return run(loop);
  if (loop.outer) {
    loop.team = loop.outer->team;
    return run(loop);
  }
  Team team(loop.limit);
  loop.team = &team;
  run(loop);
}

}  // namespace gainsmith
