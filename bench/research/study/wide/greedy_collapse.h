// SPDX-License-Identifier: Apache-2.0
// collapse_greedily() chooses wide nodes by opening the child of the largest area.
#pragma once

#include "study/wide/wide_cut.h"

namespace sobb::study {

// Opens the child of the largest area until a node has `width` children or only leaves are left.
WideCut collapse_greedily(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width);

}  // namespace sobb::study
