// SPDX-License-Identifier: Apache-2.0
// WideCut is a choice of wide nodes: it says what becomes of every node of a binary tree.
#pragma once

#include <cstdint>
#include <vector>

#include "study/binary/binary_tree.h"

namespace sobb::study {

enum class Role : uint8_t {
  kInside,  // inside a wide node (or a leaf), which takes over its children
  kWide,    // the root of a wide node
  kLeaf,    // a leaf, which includes all below it
};

using WideCut = std::vector<Role>;  // one per node; the first is a wide node's root

}  // namespace sobb::study
