// SPDX-License-Identifier: Apache-2.0
// Where and by what a run measures, in words.
#pragma once

#include <string>

#include "sobb/sobb.h"

namespace sobb::bench {

/// The processor's name as the system tells it, or "unknown".
std::string processor();

/// The instruction set that @p isa stands for on this machine. Throws where it is not there.
std::string isa_name(sobb_isa isa);

std::string library_version();
std::string embree_version();

}  // namespace sobb::bench
