// SPDX-License-Identifier: Apache-2.0
// Parallel loops: on TBB, on the caller's thread pool, or on the calling thread alone.
#pragma once

#include <cstdint>
#include <functional>

#include "sobb/sobb.h"

namespace sobb {

// Thread-safe. Loop bodies run with the default floating-point control word. An exception from a
// body is rethrown by the loop, once the bodies under way have ended; of several, the one with the
// lowest index, so that a message does not depend on the threads.
class Scheduler {
 public:
  // `threads` as in sobb_build_options: 1 is serial, 0 all that TBB gives. `callback` may be null.
  Scheduler(uint32_t threads, const sobb_scheduler* callback);

  // body(i) once for each i < count.
  void for_each(uint64_t count, const std::function<void(uint64_t)>& body) const;

  // body(begin, end) over consecutive ranges of at most `grain` items that cover [0, count).
  // The ranges depend on `count` and `grain` alone.
  void for_ranges(uint64_t count, uint64_t grain,
                  const std::function<void(uint64_t, uint64_t)>& body) const;

  // Runs body within a TBB arena of this scheduler's size (of one in serial mode and with a
  // callback), for libraries that use TBB by themselves.
  void within_arena(const std::function<void()>& body) const;

 private:
  uint32_t threads_;
  const sobb_scheduler* callback_;
};

}  // namespace sobb
