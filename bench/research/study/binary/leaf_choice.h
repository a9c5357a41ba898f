// SPDX-License-Identifier: Apache-2.0
// choose_leaves() decides which subtrees of a binary tree become leaves.
#pragma once

#include "study/binary/binary_tree.h"

namespace sobb::study {

// Makes leaves of at most kMaxLeafReferences triangles out of whole subtrees. Of all ways, it takes
// one of the least cost by the surface area heuristic. `areas` has one value per node.
BinaryTree choose_leaves(const BinaryTree& tree, const std::vector<float>& areas);

}  // namespace sobb::study
