// SPDX-License-Identifier: Apache-2.0
// The threads behind a Scheduler. tbb_threads.cpp has TBB's, std_threads.cpp the library's own for
// builds without TBB (SOBB_WITH_TBB) and for ThreadSanitizer, which cannot follow what loops hand
// over inside TBB.
#pragma once

#include <cstdint>

namespace sobb {

// Calls body(context, i) once for each i < count, on at most `threads` threads; 0 for all there
// are. The calling thread is one of them.
void run_on_threads(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t), void* context);

}  // namespace sobb
