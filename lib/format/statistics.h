// SPDX-License-Identifier: Apache-2.0
// Counts and areas of a hierarchy's nodes and leaves.
#pragma once

#include <cstdint>

#include "format/view.h"

namespace sobb {

struct Statistics {
  uint64_t leaves = 0;
  uint64_t axes_nodes = 0;    // nodes along the frame, which in a spread table is the axes
  uint64_t shared_nodes = 0;  // nodes whose children share another basis
  uint64_t own_nodes = 0;     // nodes whose children have a basis each
  double inner_area = 0;      // of inner children's volumes, over the area of the input's box
  double leaf_area = 0;       // of leaves' volumes, over the area of the input's box
};

// Areas are 0 where the input's box has none.
Statistics measure(const FileView& view);

}  // namespace sobb
