// SPDX-License-Identifier: Apache-2.0
// A data race in the body of a parallel loop of ours. The test that runs this program expects
// ThreadSanitizer to report it: no suppression, and no thread pool, hides what we do.
#include <atomic>
#include <cstdio>

#include "base/scheduler.h"

int main() {
  std::atomic<int> arrived{0};
  volatile int raced = 0;
  // Two bodies that wait for each other, so that they are on two threads; without any order between
  // them, which is what relaxed says.
  sobb::Scheduler(2, nullptr).for_each(2, [&](uint64_t) {
    arrived.fetch_add(1, std::memory_order_relaxed);
    while (arrived.load(std::memory_order_relaxed) < 2) {
    }
    for (int i = 0; i < 1000; ++i) raced = raced + 1;
  });
  std::printf("counted %d\n", raced);
}
