// SPDX-License-Identifier: Apache-2.0
#include "base/memory.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

#include "base/error.h"

namespace sobb {
namespace {

constexpr size_t kHugePage = size_t{2} << 20;

// Nodes and triangles of a large hierarchy are read at random: with 4 KiB pages most reads miss the
// TLB as well as the cache. Allocations of several huge pages are aligned to them and ask for them.
void* allocate_plain(void*, size_t size, size_t alignment) {
  const bool huge = size >= 4 * kHugePage;
  if (huge && alignment < kHugePage) alignment = kHugePage;
  if (alignment < alignof(std::max_align_t)) alignment = alignof(std::max_align_t);
  void* pointer = nullptr;
  if (posix_memalign(&pointer, alignment, size) != 0) return nullptr;
#ifdef MADV_HUGEPAGE
  if (huge) madvise(pointer, size / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return pointer;
}

void deallocate_plain(void*, void* pointer, size_t, size_t) { std::free(pointer); }

}  // namespace

Memory::Memory(const sobb_allocator* allocator, uint64_t limit)
    : allocator_(allocator ? *allocator
                           : sobb_allocator{nullptr, allocate_plain, deallocate_plain}),
      limit_(limit) {}

bool Memory::add(uint64_t bytes) {
  uint64_t held = held_.load(std::memory_order_relaxed);
  do {
    if (limit_ != 0 && (bytes > limit_ || held > limit_ - bytes)) return false;
  } while (!held_.compare_exchange_weak(held, held + bytes, std::memory_order_relaxed));
  raise_peak(held + bytes);
  return true;
}

void Memory::raise_peak(uint64_t held) {
  uint64_t peak = peak_.load(std::memory_order_relaxed);
  while (held > peak && !peak_.compare_exchange_weak(peak, held, std::memory_order_relaxed)) {
  }
}

void* Memory::do_allocate(size_t size, size_t alignment) {
  if (!add(size)) {
    fail(SOBB_ERROR_MEMORY_LIMIT,
         "memory limit: %zu bytes more would exceed the %llu allowed, %llu are held", size,
         static_cast<unsigned long long>(limit_), static_cast<unsigned long long>(held()));
  }
  void* pointer = allocator_.allocate(allocator_.user, size, alignment);
  if (pointer == nullptr) {
    held_.fetch_sub(size, std::memory_order_relaxed);
    throw std::bad_alloc();
  }
  return pointer;
}

void Memory::do_deallocate(void* pointer, size_t size, size_t alignment) {
  allocator_.deallocate(allocator_.user, pointer, size, alignment);
  held_.fetch_sub(size, std::memory_order_relaxed);
}

}  // namespace sobb
