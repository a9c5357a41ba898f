// SPDX-License-Identifier: Apache-2.0
// Which instruction set a call's kernels use. Kernels are compiled by Highway once for each; the
// choice is made here, at the call, and never inside a loop.
#pragma once

#include <string_view>

#include "sobb/sobb.h"

namespace sobb {

// SOBB_ISA_BEST resolved by the environment's SOBB_ISA or the processor, others checked.
// Errors: UNSUPPORTED_CPU, INVALID_ARGUMENT.
sobb_isa resolve_isa(uint32_t isa);

}  // namespace sobb
