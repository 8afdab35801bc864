// Loops over independent items on a few threads; loops within loops share them.
#pragma once

#include <cstddef>
#include <functional>

namespace gainsmith {

/// Calls body(0) ... body(count - 1), each once, on at most `threads` threads (0: one per core).
/// Items are handed out in order as threads come free, so results must be stored by index. The
/// exception of the lowest failing index is rethrown after all threads have stopped; later items
/// may then not have run. One thread runs all items in order on the caller.
///
/// A body may call parallel_for itself. The outermost call owns the threads: it starts them when
/// there is work for them and joins them before it returns. An inner loop starts on the thread that
/// calls it and is joined by threads that find no item further out, never by more than it asks
/// for, or than any loop around it asks for. So one thread outside means one thread everywhere.
/// Who waits for the last items of a loop meanwhile works on loops within them, on nothing else: a
/// lock that a body holds over an inner loop blocks that loop only when its own items take it.
void parallel_for(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& body);

/// The cores that this process may use: by its affinity, and by the share of time that its control
/// groups have (cpu.max).
unsigned usable_cores();

/// The number of threads for `threads`: itself, or for 0 the usable cores at the start.
unsigned thread_count(unsigned threads);

}  // namespace gainsmith
