// SPDX-License-Identifier: Apache-2.0
// Workers are the threads of every traced row. They share an array of rays out in chunks, for our
// calls and Embree's alike.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace sobb::bench {

class Workers {
 public:
  explicit Workers(int threads) : arena_(threads) {}

  /// Calls body(begin, end) for chunks of [0, count); with one thread, on the calling one.
  template <typename Body>
  void for_chunks(size_t count, const Body& body) {
    if (arena_.max_concurrency() == 1) {
      body(size_t{0}, count);
      return;
    }
    const size_t chunks = (count + kChunk - 1) / kChunk;
    arena_.execute([&] {
      tbb::parallel_for(size_t{0}, chunks, [&](size_t chunk) {
        body(chunk * kChunk, std::min(count, (chunk + 1) * kChunk));
      });
    });
  }

 private:
  static constexpr size_t kChunk = 4096;  // a multiple of every packet's size
  tbb::task_arena arena_;
};

}  // namespace sobb::bench
