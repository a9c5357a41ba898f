// SPDX-License-Identifier: Apache-2.0
// Which of Highway's targets the processor can run, as the processor itself says.
#pragma once

#include <cstdint>

namespace sobb {

// Returns the bits of the targets in base/instruction_sets.h that processor and system support.
int64_t supported_targets();

}  // namespace sobb
