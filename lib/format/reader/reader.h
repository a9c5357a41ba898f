// SPDX-License-Identifier: Apache-2.0
// Proving that bytes are a file that is safe to trace.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>

#include "base/progress.h"
#include "base/scheduler.h"
#include "format/view.h"

namespace sobb {

// The part of opening's progress that the bytes take to come, by measured time.
inline constexpr double kReadEnd = 0.5;

// Checks everything that docs/format.md states, and returns the view; throws Error with one
// SOBB_ERROR_FORMAT_ status a cause, the message naming `name` and the place. `scratch` holds a
// byte a node and a bit a block meanwhile. Progress runs from kReadEnd to 1.
FileView read_image(std::span<const std::byte> bytes, const char* name, const Scheduler& scheduler,
                    std::pmr::memory_resource& scratch, Progress& progress);

}  // namespace sobb
