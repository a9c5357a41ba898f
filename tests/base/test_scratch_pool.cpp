// SPDX-License-Identifier: Apache-2.0
// Blocks for tasks: used again, as many as are out at once, none where there is no memory, and all
// given back.
#include "base/scratch_pool.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

namespace sobb {
namespace {

constexpr size_t kSize = 1000;

// Keeps the books of what is held; throws once `limit` blocks are.
class CountingResource final : public std::pmr::memory_resource {
 public:
  explicit CountingResource(size_t limit = SIZE_MAX) : limit_(limit) {}
  ~CountingResource() override { EXPECT_TRUE(held_.empty()) << held_.size() << " are left"; }

  size_t held() const { return held_.size(); }
  size_t calls() const { return calls_; }

 private:
  void* do_allocate(size_t size, size_t alignment) override {
    const std::lock_guard lock(mutex_);
    ++calls_;
    EXPECT_EQ(size, kSize);
    EXPECT_EQ(alignment, 64U);
    if (held_.size() >= limit_) throw std::bad_alloc();
    void* const block = std::pmr::new_delete_resource()->allocate(size, alignment);
    held_.insert(block);
    return block;
  }

  void do_deallocate(void* block, size_t size, size_t alignment) override {
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(held_.erase(block), 1U) << "a block comes back that was not given";
    EXPECT_EQ(size, kSize);
    EXPECT_EQ(alignment, 64U);
    std::pmr::new_delete_resource()->deallocate(block, size, alignment);
  }

  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::mutex mutex_;
  std::set<void*> held_;
  size_t limit_;
  size_t calls_ = 0;
};

TEST(ScratchPool, TakesNothingUntilAsked) {
  CountingResource memory;
  const ScratchPool pool(memory, kSize);
  EXPECT_EQ(memory.calls(), 0U);
}

TEST(ScratchPool, BlocksAreUsedAgain) {
  CountingResource memory;
  {
    ScratchPool pool(memory, kSize);
    void* first = nullptr;
    for (int round = 0; round < 10; ++round) {
      const ScratchPool::Lease lease(pool);
      ASSERT_NE(lease.get(), nullptr);
      EXPECT_EQ(reinterpret_cast<uintptr_t>(lease.get()) % 64, 0U);
      std::memset(lease.get(), 0xFF, kSize);
      if (round == 0) first = lease.get();
      EXPECT_EQ(lease.get(), first);
    }
    EXPECT_EQ(memory.calls(), 1U);
  }
  EXPECT_EQ(memory.held(), 0U);
}

TEST(ScratchPool, HasAsManyBlocksAsAreOutAtOnce) {
  CountingResource memory;
  ScratchPool pool(memory, kSize);
  for (int round = 0; round < 3; ++round) {
    const ScratchPool::Lease a(pool);
    const ScratchPool::Lease b(pool);
    const ScratchPool::Lease c(pool);
    EXPECT_EQ((std::set{a.get(), b.get(), c.get()}.size()), 3U);
  }
  EXPECT_EQ(memory.held(), 3U);
}

TEST(ScratchPool, LeaseIsEmptyWithoutMemory) {
  CountingResource memory(1);
  ScratchPool pool(memory, kSize);
  {
    std::optional<ScratchPool::Lease> first(std::in_place, pool);
    EXPECT_NE(first->get(), nullptr);
    const ScratchPool::Lease second(pool);
    EXPECT_EQ(second.get(), nullptr);
    first.reset();
    const ScratchPool::Lease third(pool);
    EXPECT_NE(third.get(), nullptr) << "what came back is there again";
  }
  EXPECT_EQ(memory.held(), 1U);
}

TEST(ScratchPool, ThreadsNeverShareABlock) {
  CountingResource memory(3);  // fewer than threads
  {
    ScratchPool pool(memory, kSize);
    std::vector<std::thread> threads;
    threads.reserve(4);
    for (int id = 0; id < 4; ++id) {
      threads.emplace_back([&pool, id] {
        for (int round = 0; round < 2000; ++round) {
          const ScratchPool::Lease lease(pool);
          if (lease.get() == nullptr) continue;
          auto* const bytes = static_cast<unsigned char*>(lease.get());
          std::memset(bytes, id, kSize);
          EXPECT_EQ(bytes[0], id);
          EXPECT_EQ(bytes[kSize - 1], id);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_LE(memory.held(), 3U);
  }
  EXPECT_EQ(memory.held(), 0U);
}

}  // namespace
}  // namespace sobb
