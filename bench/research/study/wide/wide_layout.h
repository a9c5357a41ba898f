// SPDX-License-Identifier: Apache-2.0
// A choice of wide nodes as the library's build takes it.
#pragma once

#include <memory_resource>

#include "builder/wide/collapse.h"
#include "study/wide/wide_cut.h"

namespace sobb::study {

// All nodes are in the topology's top: the build that follows is then a serial one.
struct WideLayout {
  std::vector<uint32_t> primitives;  // which the topology borrows
  WideTopology topology;
  uint64_t leaf_count = 0;
  double mean_leaf_depth = 0;  // wide nodes above a leaf
};

// Depth first, siblings next to each other. Errors: INTERNAL where it is too deep for a file.
WideLayout lay_out(const BinaryTree& tree, const WideCut& cut, std::pmr::memory_resource& memory);

}  // namespace sobb::study
