// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/node_bases.h"

#include <algorithm>

namespace sobb {

NodeBases frame_bases(uint32_t count) {
  NodeBases bases{};
  std::fill(bases.basis, bases.basis + count, kAxesBasis);
  bases.shared = true;
  bases.cost = kFrameCost;
  return bases;
}

NodeBasisChooser::NodeBasisChooser(std::span<const Direction> directions, float radius,
                                   sobb_strategy strategy, const BoundsKernels& kernels,
                                   std::pmr::memory_resource& memory)
    : kernels_(kernels),
      strategy_(strategy),
      table_(directions, memory),
      scale_(radius > 0 ? 1 / radius : 1) {}

void NodeBasisChooser::find_own_basis(BoundedChild& child) const {
  alignas(64) float width[kMaxDirections];
  kernels_.widths(child.kdop, scale_, width);
  const TripleChoice choice =
      or_frame(table_, width, kernels_.choose_one(table_, width, strategy_));
  child.basis = make_basis(choice.direction[0], choice.direction[1], choice.direction[2]);
  child.area = choice.area;
}

// The surface area heuristic decides between the frame for all children, one other basis for all,
// and a basis per child:
//   area(node) * cost(test) + sum area(child) * cost(child)
// A ray meets the nodes below the children equally often whatever bounds these, so only the tests
// that follow a hit of a child count. The shared basis is the one of the least sum of areas; with
// the least sum of costs rays test some more triangles (docs/study.md).
NodeBases NodeBasisChooser::choose(uint32_t count, const BoundedChild* const* child,
                                   float node_area) const {
  NodeBases bases = frame_bases(count);
  Gram gram = {};
  float own = 0;
  for (uint32_t i = 0; i < count; ++i) {
    kernels_.add_to_gram(child[i]->kdop, scale_, 1, gram);
    own += child[i]->area * child[i]->cost;
  }
  const uint16_t least = kernels_.choose(table_, gram, strategy_).basis;
  const float frame = kFrameCost * node_area + children_total(count, child, kAxesBasis);
  const float shared = kSharedCost * node_area + children_total(count, child, least);
  own += kOwnCost * node_area;
  bases.frame_total = frame;
  bases.chosen_total = std::min({frame, shared, own});
  if (own < std::min(frame, shared)) {
    for (uint32_t i = 0; i < count; ++i) bases.basis[i] = child[i]->basis;
    bases.shared = false;
    bases.cost = kOwnCost;
  } else if (shared < frame) {
    std::fill(bases.basis, bases.basis + count, least);
    bases.cost = kSharedCost;
  }
  return bases;
}

// sum area(child) * cost(child) with all children in one basis, where each area is
// 2 (d0 d1 + d1 d2 + d2 d0) / |det|.
float NodeBasisChooser::children_total(uint32_t count, const BoundedChild* const* child,
                                       uint16_t basis) const {
  const uint32_t k[3] = {basis_direction(basis, 0), basis_direction(basis, 1),
                         basis_direction(basis, 2)};
  float sum = 0;
  for (uint32_t i = 0; i < count; ++i) {
    float d[3];
    for (int j = 0; j < 3; ++j) {
      d[j] = (child[i]->kdop.upper[k[j]] - child[i]->kdop.lower[k[j]]) * scale_;
    }
    sum += (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) * child[i]->cost;
  }
  return 2 * sum * table_.inverse_determinants(k[0], k[1])[k[2]];
}

}  // namespace sobb
