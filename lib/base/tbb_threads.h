// SPDX-License-Identifier: Apache-2.0
// What a Scheduler asks of TBB. ThreadSanitizer cannot follow what loops hand over inside TBB: its
// build has other threads behind these functions, tests/support/tbb_stand_in.cpp.
#pragma once

#include <cstdint>

namespace sobb {

// Calls body(context, i) once for each i < count, on at most `threads` threads; 0 for all there
// are.
void run_on_tbb(uint32_t threads, uint64_t count, void (*body)(void*, uint64_t), void* context);

// Calls body(context) where TBB, used by another library, has at most `threads` threads; 0 for all.
void run_in_tbb_arena(uint32_t threads, void (*body)(void*), void* context);

}  // namespace sobb
