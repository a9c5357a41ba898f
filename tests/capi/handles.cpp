// SPDX-License-Identifier: Apache-2.0
#include "capi/handles.h"

#include <atomic>
#include <thread>

namespace sobb::test {

void run_on_threads(void*, uint64_t count, void (*body)(void*, uint64_t), void* context) {
  std::atomic<uint64_t> next{0};
  const auto work = [&] {
    for (uint64_t i = next++; i < count; i = next++) body(context, i);
  };
  std::thread threads[] = {std::thread(work), std::thread(work), std::thread(work)};
  for (std::thread& thread : threads) thread.join();
}

}  // namespace sobb::test
