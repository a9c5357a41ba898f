// SPDX-License-Identifier: Apache-2.0
// Writing a node of the file and a leaf's triangle blocks.
#pragma once

#include <cstdint>
#include <span>

#include "builder/mesh.h"
#include "builder/volumes/node_bases.h"
#include "builder/wide/wide_topology.h"
#include "format/layout.h"

namespace sobb {

// Writes all bytes of a node: its children's slabs in the bases chosen for them.
template <int W>
void write_node(const WideNode& wide, const BoundedChild* const* child, const NodeBases& bases,
                Node<W>& node) {
  node = {};
  for (uint32_t i = 0; i < wide.child_count; ++i) {
    for (int j = 0; j < 3; ++j) {
      const uint32_t direction = basis_direction(bases.basis[i], j);
      node.slab[j][0][i] = child[i]->kdop.lower[direction];
      node.slab[j][1][i] = child[i]->kdop.upper[direction];
    }
    node.reference[i] = wide.index[i];
    node.basis[i] = bases.basis[i];
    if (wide.is_leaf(i)) node.meta[i] = static_cast<uint16_t>(kLeafBit | wide.count[i]);
  }
  node.meta[0] |= static_cast<uint16_t>(wide.child_count << kChildCountShift);
  if (bases.shared) node.meta[0] |= kSharedBit;
}

// Writes all bytes of a leaf's triangle blocks, blocks_of(primitives.size()) of them.
void write_blocks(const Mesh& mesh, std::span<const uint32_t> primitives, TriangleBlock* blocks);

}  // namespace sobb
