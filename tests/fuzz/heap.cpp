#include "fuzz/heap.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max() / 2;

std::atomic<std::size_t> in_use = 0;
std::atomic<std::size_t> most = kUnlimited;

/// Null where it would be too much.
void* try_to_allocate(std::size_t size) noexcept {
  if (size > most || in_use + size > most) return nullptr;
  void* const memory = std::malloc(size > 0 ? size : 1);
  in_use += malloc_usable_size(memory);
  return memory;
}

void* allocate(std::size_t size) {
  if (void* const memory = try_to_allocate(size)) return memory;
  throw std::bad_alloc();
}

void release(void* memory) {
  in_use -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return try_to_allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return try_to_allocate(size);
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }

namespace gainsmith::fuzz {

HeapLimit::HeapLimit(std::size_t bytes) { most = in_use + bytes; }
HeapLimit::~HeapLimit() { most = kUnlimited; }

}  // namespace gainsmith::fuzz
