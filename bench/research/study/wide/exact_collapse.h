// SPDX-License-Identifier: Apache-2.0
// collapse_exactly() finds the wide nodes of the least cost by the surface area heuristic (H.
// Ylitie et al., Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017).
#pragma once

#include "study/wide/wide_cut.h"

namespace sobb::study {

// Keeps the tree's leaves, or lets subtrees of at most kMaxLeafReferences triangles become leaves,
// too.
enum class Leaves { kKept, kChosen };

// Dynamic programming finds C(n, i), the cost of what lies below node n as a forest of at most i
// roots:
//   C(n, 1) = min(area(n) blocks(n), area(n) node + D(n, W))
//   C(n, i) = min(D(n, i), C(n, i - 1))
//   D(n, i) = min over 0 < k < i of C(left, k) + C(right, i - k)
// builder/wide/least_cost_cut.h is the library's form of it, for the areas of boxes. Equal costs go
// to fewer roots, to a leaf, and to fewer roots on the left.
WideCut collapse_exactly(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width,
                         Leaves leaves);

}  // namespace sobb::study
