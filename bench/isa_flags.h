// SPDX-License-Identifier: Apache-2.0
// The values of --isa and --embree-isa: the library's instruction sets, by our names and Embree's.
#pragma once

#include <string>
#include <vector>

#include "sobb/sobb.h"

namespace sobb::bench {

/// The value of --embree-isa that holds Embree to the set of our kernels.
inline constexpr const char* kSameIsa = "same";

/// What --isa may be: "best" and the sets' names.
std::vector<std::string> isa_choices();

/// Embree's device option `isa` for the set that @p isa stands for on this machine. Throws where it
/// is not there.
std::string embree_isa_name(sobb_isa isa);

}  // namespace sobb::bench
