// SPDX-License-Identifier: Apache-2.0
// Which subtrees of a binary tree are leaves.
#pragma once

#include "study/binary/binary_tree.h"

namespace sobb::study {

// The least cost by the surface area heuristic over all ways to make leaves of at most
// kMaxLeafReferences triangles out of whole subtrees. `areas` are the nodes'.
BinaryTree choose_leaves(const BinaryTree& tree, const std::vector<float>& areas);

}  // namespace sobb::study
