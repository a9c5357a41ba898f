// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/node_writer.h"

#include <algorithm>

namespace sobb {

void write_blocks(const Mesh& mesh, std::span<const uint32_t> primitives, TriangleBlock* blocks) {
  const uint64_t block_count = blocks_of(primitives.size());
  std::fill_n(blocks, block_count, TriangleBlock{});
  for (uint64_t at = 0; at < 4 * block_count; ++at) {
    TriangleBlock& block = blocks[at / 4];
    const uint64_t lane = at % 4;
    if (at >= primitives.size()) {
      block.primitive[lane] = kNoPrimitive;
      continue;
    }
    const uint32_t primitive = primitives[at];
    for (int vertex = 0; vertex < 3; ++vertex) {
      const Point corner = mesh.corner(primitive, vertex);
      block.vertex[vertex][0][lane] = corner.x;
      block.vertex[vertex][1][lane] = corner.y;
      block.vertex[vertex][2][lane] = corner.z;
    }
    block.primitive[lane] = primitive;
  }
}

}  // namespace sobb
