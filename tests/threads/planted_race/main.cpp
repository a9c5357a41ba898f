// SPDX-License-Identifier: Apache-2.0
// A data race in the bodies of a parallel loop of ours. The test that runs this program expects
// ThreadSanitizer to report it: no suppression, and no thread pool, hides what we do.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>

#include "base/scheduler.h"

int main() {
  constexpr uint64_t kBodies = 2, kTurns = 20;
  std::atomic<uint64_t> turn{0};
  volatile int raced = 0;
  // The bodies take turns, so that they are on two threads and each meets what the other wrote;
  // but without any order that the language knows between them, which is what relaxed says. Many
  // turns: ThreadSanitizer may miss a race that happens once (3 to 5 of 1000 runs, clang 14).
  sobb::Scheduler(kBodies, nullptr).for_each(kBodies, [&](uint64_t body) {
    for (uint64_t mine = body; mine < kTurns; mine += kBodies) {
      while (turn.load(std::memory_order_relaxed) != mine) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
      raced = raced + 1;
      turn.fetch_add(1, std::memory_order_relaxed);
    }
  });
  std::printf("counted %d\n", raced);
}
