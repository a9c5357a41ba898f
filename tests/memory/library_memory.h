// SPDX-License-Identifier: Apache-2.0
// All that the library allocates: by the caller's allocator, and by operator new behind its back.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "sobb/sobb.h"

namespace sobb::test {

// Behind the program's operator new (replaced_new.cpp).
constexpr size_t kNewAlignment = 64;
void* new_block(size_t size) noexcept;  // null without memory
void delete_block(void* pointer) noexcept;

// What is held of one kind of allocation.
struct Holdings {
  std::atomic<uint64_t> calls{0};
  std::atomic<uint64_t> blocks{0};
  std::atomic<uint64_t> bytes{0};
  std::atomic<uint64_t> peak{0};

  void take(uint64_t size);
  void give_back(uint64_t size);
};

// Counts while it lives, one at a time. TBB and the test itself do not count.
class LibraryMemory {
 public:
  static constexpr uint64_t kNever = UINT64_MAX;

  // The allocation number `fail_at`, of both kinds together, fails.
  explicit LibraryMemory(uint64_t fail_at = kNever);
  ~LibraryMemory();
  LibraryMemory(const LibraryMemory&) = delete;
  LibraryMemory& operator=(const LibraryMemory&) = delete;

  // The allocation after the next `count` fails.
  void fail_after(uint64_t count) { fail_at_ = calls_ + count; }

  const sobb_allocator* allocator() const { return &allocator_; }
  bool failed() const { return calls_ > fail_at_; }
  uint64_t calls() const { return calls_; }

  bool refuses() { return calls_++ == fail_at_; }  // the next allocation

  Holdings through_allocator;
  Holdings by_new;

 private:
  static void* allocate(void* user, size_t size, size_t alignment);
  static void deallocate(void* user, void* pointer, size_t size, size_t alignment);

  sobb_allocator allocator_{this, allocate, deallocate};
  uint64_t fail_at_;
  std::atomic<uint64_t> calls_{0};
};

}  // namespace sobb::test
