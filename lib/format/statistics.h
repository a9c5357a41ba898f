// SPDX-License-Identifier: Apache-2.0
// Sums over a hierarchy's nodes.
#pragma once

#include <cstdint>

#include "format/view.h"

namespace sobb {

struct Statistics {
  uint64_t leaves = 0;
  uint64_t axes_nodes = 0;    // one basis for all children: the axes
  uint64_t shared_nodes = 0;  // one basis for all children: another
  uint64_t own_nodes = 0;     // a basis for each child
  double inner_area = 0;      // of inner children's volumes, over the area of the input's box
  double leaf_area = 0;       // of leaves' volumes, likewise
};

// Areas are 0 where the input's box has none.
Statistics measure(const FileView& view);

}  // namespace sobb
