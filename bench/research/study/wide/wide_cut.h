// SPDX-License-Identifier: Apache-2.0
// A choice of wide nodes: what becomes of every node of a binary tree.
#pragma once

#include <cstdint>
#include <vector>

#include "study/binary/binary_tree.h"

namespace sobb::study {

enum class Role : uint8_t {
  kInside,  // of a wide node (or of a leaf): its children are that one's
  kWide,    // the root of a wide node
  kLeaf,    // a leaf, all below it included
};

using WideCut = std::vector<Role>;  // by node; the first is a wide node's root

}  // namespace sobb::study
