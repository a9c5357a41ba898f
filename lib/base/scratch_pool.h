// SPDX-License-Identifier: Apache-2.0
// ScratchPool lends blocks of memory of one size to the tasks of a loop: as many as run at once.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <mutex>
#include <new>

namespace sobb {

// Thread-safe. It owns the blocks, which must all be back when it is destroyed.
class ScratchPool {
 public:
  // Blocks have at least a pointer's size and are aligned to 64 bytes.
  ScratchPool(std::pmr::memory_resource& memory, size_t block_size)
      : memory_(memory), block_size_(block_size) {}
  ~ScratchPool() {
    while (free_ != nullptr) {
      Block* const block = free_;
      free_ = block->next;
      memory_.deallocate(block, block_size_, kAlignment);
    }
  }
  ScratchPool(const ScratchPool&) = delete;
  ScratchPool& operator=(const ScratchPool&) = delete;

  // Holds one block while it lives; null where there is no memory.
  class Lease {
   public:
    explicit Lease(ScratchPool& pool) : pool_(pool), block_(pool.take()) {}
    ~Lease() { pool_.give_back(block_); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    void* get() const { return block_; }

   private:
    ScratchPool& pool_;
    void* block_;
  };

 private:
  static constexpr size_t kAlignment = 64;
  struct Block {
    Block* next;
  };

  void* take() noexcept {
    {
      const std::lock_guard lock(mutex_);
      if (free_ != nullptr) {
        Block* const block = free_;
        free_ = block->next;
        return block;
      }
    }
    try {
      return memory_.allocate(block_size_, kAlignment);
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
  }

  void give_back(void* block) noexcept {
    if (block == nullptr) return;
    const std::lock_guard lock(mutex_);
    free_ = new (block) Block{free_};
  }

  std::pmr::memory_resource& memory_;
  size_t block_size_;
  std::mutex mutex_;
  Block* free_ = nullptr;
};

}  // namespace sobb
