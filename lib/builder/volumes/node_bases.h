// SPDX-License-Identifier: Apache-2.0
// Choosing the bases of a node's children by the surface area heuristic.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>

#include "bounds/bounds_kernels.h"
#include "builder/wide/wide_topology.h"

namespace sobb {

// What a ray pays for the test of a node, in units of a test along the frame, by the node's bases:
// along the frame, one other basis for all children, or a basis per child. Directions other than
// the frame's must be looked up, or made; then a basis per child costs little more than a shared
// one. (Measured by rays per second of hair, hairball, pipes, leaves and crown, single rays and
// batches. With a shared cost of 1, leaves and crown lose up to 6 % to AABBs; with an own cost
// of 2.6, hairball loses up to 5 %.)
inline constexpr float kFrameCost = 1.0F;
inline constexpr float kSharedCost = 1.8F;
inline constexpr float kOwnCost = 2.0F;
// What a ray pays for the test of a triangle block, in the same unit.
inline constexpr float kBlockCost = 1.0F;

// A child as its parent's bases depend on it.
struct BoundedChild {
  Kdop kdop;
  float cost = 0;  // of the test that follows a hit of the child: of its node, or of its blocks
  // The child's own best basis, and its area in that over the squared radius of the scene. They are
  // left as they are where no bases are chosen.
  float area = 0;
  uint16_t basis = kAxesBasis;
};

// The bases of a node's children, and what they cost.
struct NodeBases {
  uint16_t basis[kMaxWidth];
  bool shared;  // all children have the same
  float cost;   // of the node's test
  // Cost times area, summed over the node's test and its children's: as chosen, and with all bases
  // along the frame. 0 where no bases are chosen.
  float chosen_total;
  float frame_total;
};

// Puts all children on the frame.
NodeBases frame_bases(uint32_t count);

class NodeBasisChooser {
 public:
  NodeBasisChooser(std::span<const Direction> directions, float radius, sobb_strategy strategy,
                   const BoundsKernels& kernels, std::pmr::memory_resource& memory);

  // Finds the best basis of one child alone, and its area there.
  void find_own_basis(BoundedChild& child) const;

  // Chooses the bases of a node whose own best area is `node_area`.
  NodeBases choose(uint32_t count, const BoundedChild* const* child, float node_area) const;

 private:
  float children_total(uint32_t count, const BoundedChild* const* child, uint16_t basis) const;

  const BoundsKernels& kernels_;
  sobb_strategy strategy_;
  BasisTable table_;
  float
      scale_;  // one over the radius: makes widths so small that areas neither overflow nor vanish
};

}  // namespace sobb
