// SPDX-License-Identifier: Apache-2.0
// WideLayout is a choice of wide nodes in the form that the library's build takes.
#pragma once

#include <memory_resource>

#include "builder/wide/collapse.h"
#include "study/wide/wide_cut.h"

namespace sobb::study {

// All nodes are in the topology's top, so the build that follows is serial.
struct WideLayout {
  std::vector<uint32_t> primitives;  // borrowed by the topology
  WideTopology topology;
  uint64_t leaf_count = 0;
  double mean_leaf_depth = 0;  // wide nodes above a leaf
};

// Lays nodes out depth first, siblings next to each other. Fails with INTERNAL where the result is
// too deep for a file.
WideLayout lay_out(const BinaryTree& tree, const WideCut& cut, std::pmr::memory_resource& memory);

}  // namespace sobb::study
