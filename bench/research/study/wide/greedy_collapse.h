// SPDX-License-Identifier: Apache-2.0
// Wide nodes as the library chooses them, by any areas.
#pragma once

#include "study/wide/wide_cut.h"

namespace sobb::study {

// Opens the child of the largest area until `width` children are found or only leaves are left.
WideCut collapse_greedily(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width);

}  // namespace sobb::study
