// SPDX-License-Identifier: Apache-2.0
// Words for where and by what a run measures: processor, instruction set, versions, strategy.
#pragma once

#include <string>

#include "sobb/sobb.h"

namespace sobb::bench {

/// The processor's name as the system tells it, or "unknown".
std::string processor();

/// The instruction set that @p isa stands for on this machine. Throws where it is not there.
std::string isa_name(sobb_isa isa);

/// "k", "k2" or "k3".
std::string strategy_name(uint32_t strategy);

std::string library_version();

}  // namespace sobb::bench
