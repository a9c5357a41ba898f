// SPDX-License-Identifier: Apache-2.0
// Wide nodes of the least cost by the surface area heuristic that a binary tree has in it (H.
// Ylitie et al., Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017).
#pragma once

#include "study/wide/wide_cut.h"

namespace sobb::study {

// Whether the tree's leaves stay, or subtrees of at most kMaxLeafReferences triangles may become
// leaves, too.
enum class Leaves { kKept, kChosen };

// By dynamic programming over the cost of what lies below a node as a forest of at most i roots:
//   C(n, 1) = min(area(n) blocks(n), area(n) node + D(n, W))
//   C(n, i) = min(D(n, i), C(n, i - 1)),  D(n, i) = min over 0 < k < i of C(left, k) + C(right,
//   i-k)
// Equal costs go to fewer roots, to a leaf, and to fewer roots on the left.
WideCut collapse_exactly(const BinaryTree& tree, const std::vector<float>& areas, uint32_t width,
                         Leaves leaves);

}  // namespace sobb::study
