// SPDX-License-Identifier: Apache-2.0
// Memory: alignment, what is held and at most was, the limit, the caller's allocator.
#include "base/memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory_resource>
#include <new>
#include <thread>
#include <vector>

#include "base/error.h"

namespace sobb {
namespace {

constexpr size_t kMiB = size_t{1} << 20;

TEST(Memory, CountsWhatIsHeldAndItsPeak) {
  Memory memory;
  void* first = memory.allocate(100, 8);
  void* second = memory.allocate(50, 8);
  EXPECT_EQ(memory.held(), 150u);
  memory.deallocate(first, 100, 8);
  EXPECT_EQ(memory.held(), 50u);
  memory.deallocate(second, 50, 8);
  EXPECT_EQ(memory.held(), 0u);
  EXPECT_EQ(memory.peak(), 150u);
}

TEST(Memory, AlignsAsAskedAndLargeBlocksToHugePages) {
  Memory memory;
  const auto misalignment = [&](size_t size, size_t alignment, size_t expected) {
    void* pointer = memory.allocate(size, alignment);
    const uintptr_t rest = reinterpret_cast<uintptr_t>(pointer) % expected;
    std::memset(pointer, 0xFF, size);
    memory.deallocate(pointer, size, alignment);
    return rest;
  };
  for (const size_t alignment : {1, 4, 16, 64, 4096}) {
    EXPECT_EQ(misalignment(10, alignment, alignment), 0u) << alignment;
  }
  EXPECT_EQ(misalignment(16 * kMiB, 64, 2 * kMiB), 0u);
}

TEST(Memory, RefusesWhatWouldExceedTheLimit) {
  Memory memory(nullptr, 1000);
  void* pointer = memory.allocate(600, 8);
  try {
    static_cast<void>(memory.allocate(401, 8));
    FAIL() << "401 bytes more were given";
  } catch (const Error& error) {
    EXPECT_EQ(error.status, SOBB_ERROR_MEMORY_LIMIT);
    EXPECT_STREQ(error.what(),
                 "memory limit: 401 bytes more would exceed the 1000 allowed, 600 are held");
  }
  EXPECT_EQ(memory.held(), 600u);
  EXPECT_EQ(memory.peak(), 600u);
  EXPECT_THROW(static_cast<void>(memory.allocate(SIZE_MAX, 8)), Error);  // no overflow
  void* rest = memory.allocate(400, 8);
  memory.deallocate(rest, 400, 8);
  memory.deallocate(pointer, 600, 8);
}

TEST(Memory, LiftedLimitBindsNoMore) {
  Memory memory(nullptr, 10);
  EXPECT_THROW(static_cast<void>(memory.allocate(11, 1)), Error);
  memory.lift_limit();
  memory.deallocate(memory.allocate(11, 1), 11, 1);
}

// A caller's allocator that counts, and fails on demand.
struct CountingAllocator {
  uint64_t calls = 0;
  uint64_t bytes = 0;
  bool fails = false;

  static void* allocate(void* user, size_t size, size_t alignment) {
    auto* self = static_cast<CountingAllocator*>(user);
    if (self->fails) return nullptr;
    ++self->calls;
    self->bytes += size;
    return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  }
  static void deallocate(void* user, void* pointer, size_t size, size_t) {
    static_cast<CountingAllocator*>(user)->bytes -= size;
    std::free(pointer);
  }
};

TEST(Memory, GoesThroughTheCallersAllocator) {
  CountingAllocator counting;
  const sobb_allocator allocator = {&counting, CountingAllocator::allocate,
                                    CountingAllocator::deallocate};
  Memory memory(&allocator);
  {
    std::pmr::vector<double> numbers(1000, 1.5, &memory);
    EXPECT_EQ(counting.bytes, 8000u);
    EXPECT_EQ(memory.held(), 8000u);
  }
  EXPECT_EQ(counting.calls, 1u);
  EXPECT_EQ(counting.bytes, 0u);
}

TEST(Memory, FailingAllocatorIsBadAllocAndNothingIsHeld) {
  CountingAllocator counting;
  counting.fails = true;
  const sobb_allocator allocator = {&counting, CountingAllocator::allocate,
                                    CountingAllocator::deallocate};
  Memory memory(&allocator);
  EXPECT_THROW(static_cast<void>(memory.allocate(8, 8)), std::bad_alloc);
  EXPECT_EQ(memory.held(), 0u);
}

TEST(Memory, ThreadsNeverHoldMoreThanTheLimit) {
  constexpr uint64_t kLimit = 1000;
  Memory memory(nullptr, kLimit);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&memory] {
      for (int round = 0; round < 2000; ++round) {
        try {
          memory.deallocate(memory.allocate(400, 8), 400, 8);
        } catch (const Error&) {
          continue;  // the others hold too much at the moment
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(memory.held(), 0u);
  EXPECT_LE(memory.peak(), kLimit);
  EXPECT_GE(memory.peak(), 400u);
}

}  // namespace
}  // namespace sobb
