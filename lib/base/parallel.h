// A loop over independent items on a few threads.
#pragma once

#include <cstddef>
#include <functional>

namespace gainsmith {

/// Calls body(0) ... body(count - 1), each once, on at most `threads` threads (0: one per core).
/// Items are handed out in order as threads come free, so results must be stored by index. The
/// exception of the lowest failing index is rethrown after all threads have stopped; later items
/// may then not have run.
void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& body);

/// The number of threads that `threads` stands for: itself, or the number of cores for 0.
unsigned thread_count(unsigned threads);

}  // namespace gainsmith
