// How much memory there is.
#pragma once

namespace gainsmith {

/// Bytes that this process may use: the least of the machine's memory, the limits of its control
/// groups and that of its address space. It does not depend on what others use.
double memory_limit();

}  // namespace gainsmith
