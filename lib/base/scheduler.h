// SPDX-License-Identifier: Apache-2.0
// Scheduler runs parallel loops: on TBB or the library's own threads, on the caller's thread pool,
// or on the calling thread alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "sobb/sobb.h"

namespace sobb {

// Thread-safe. Loop bodies run with the default floating-point control word. An exception from a
// body is rethrown by the loop, once all bodies below it have ended; of several exceptions, that of
// the lowest index, so that a message does not depend on the threads. Loops allocate nothing.
class Scheduler {
 public:
  // `threads` as in sobb_build_options: 1 is serial, 0 all that there are. `callback` may be null.
  Scheduler(uint32_t threads, const sobb_scheduler* callback)
      : threads_(threads), callback_(callback) {}

  // Calls body(i) once for each i < count.
  template <class Body>
  void for_each(uint64_t count, Body&& body) const {
    using Plain = std::remove_reference_t<Body>;
    run(
        count, [](void* context, uint64_t i) { (*static_cast<Plain*>(context))(i); }, &body);
  }

  // Calls body(begin, end) for consecutive ranges of at most `grain` items that cover [0, count).
  // The ranges depend on `count` and `grain` alone.
  template <class Body>
  void for_ranges(uint64_t count, uint64_t grain, Body&& body) const {
    for_each((count + grain - 1) / grain,
             [&](uint64_t range) { body(range * grain, std::min(count, (range + 1) * grain)); });
  }

 private:
  void run(uint64_t count, void (*body)(void*, uint64_t), void* context) const;

  uint32_t threads_;
  const sobb_scheduler* callback_;
};

}  // namespace sobb
