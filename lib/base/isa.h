// SPDX-License-Identifier: Apache-2.0
// Instruction sets by value and by name, and the one that a call's kernels use. It is chosen at the
// call and never inside a loop.
#pragma once

#include <cstdint>
#include <string_view>

#include "sobb/sobb.h"

namespace sobb {

// How many sets the table has; their values are 1 to that.
uint32_t isa_count();

// A set's name and title (base/instruction_sets.h), "best" for SOBB_ISA_BEST, "unknown" for a value
// that is no sobb_isa.
const char* isa_name(uint32_t isa);
const char* isa_title(uint32_t isa);

// The value with a name. `what` names the argument in the error's message.
// Errors: INVALID_ARGUMENT.
sobb_isa isa_from_name(std::string_view name, const char* what);

// The set that `isa` stands for on this processor: SOBB_ISA_BEST is the environment's SOBB_ISA, or
// else the best that the processor has; any other value is itself.
// Errors: UNSUPPORTED_CPU, INVALID_ARGUMENT.
sobb_isa resolve_isa(uint32_t isa);

}  // namespace sobb
