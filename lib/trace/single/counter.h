// SPDX-License-Identifier: Apache-2.0
// Counts the work of a ray, or does nothing at no cost.
#pragma once

#include <cstdint>

#include "format/layout.h"
#include "sobb/sobb.h"

namespace sobb {

struct NoCounter {
  void add_node(uint32_t) {}
  void add_leaf(uint32_t) {}
};

struct WorkCounter {
  sobb_count& count;

  void add_node(uint32_t children) {
    ++count.nodes;
    count.volumes += children;
  }
  void add_leaf(uint32_t triangles) {
    count.blocks += static_cast<uint32_t>(blocks_of(triangles));
    count.triangles += triangles;
  }
};

}  // namespace sobb
