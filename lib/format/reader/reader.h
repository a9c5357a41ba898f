// SPDX-License-Identifier: Apache-2.0
// Proving that bytes are a file that is safe to trace.
//
// The room `format/reader` is that proof, one file per step (validate.h lists them). It knows
// `format` and the default direction tables of `bounds`.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>

#include "base/progress.h"
#include "base/scheduler.h"
#include "format/view.h"

namespace sobb {

// The share of opening's progress in which the bytes are read, by measured time.
inline constexpr double kReadEnd = 0.5;

// Checks everything that docs/format.md states, and returns the view. Throws Error with one
// SOBB_ERROR_FORMAT_ status per cause; the message names `name` and the place. Meanwhile `scratch`
// holds one byte per node and one bit per block. Progress runs from kReadEnd to 1.
FileView read_image(std::span<const std::byte> bytes, const char* name, const Scheduler& scheduler,
                    std::pmr::memory_resource& scratch, Progress& progress);

}  // namespace sobb
