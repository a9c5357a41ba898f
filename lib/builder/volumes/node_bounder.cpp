// SPDX-License-Identifier: Apache-2.0
#include "builder/volumes/node_bounder.h"

#include "builder/volumes/leaf_kdop.h"
#include "format/layout.h"

namespace sobb {

NodeBounder::NodeBounder(const VolumeScene& scene, std::optional<sobb_strategy> strategy,
                         const BoundsKernels& kernels, std::pmr::memory_resource& memory)
    : scene_(scene),
      kernels_(kernels),
      directions_(make_direction_table(strategy ? scene.directions : scene.directions.first(3))) {
  if (strategy) chooser_.emplace(scene.directions, scene.radius, *strategy, kernels, memory);
}

void NodeBounder::bound_leaf(const References& leaf, BoundedChild& bounded) const {
  fit_leaf(scene_.mesh, leaf, directions_, scene_.centre, kernels_, bounded.kdop, scene_.frame);
  bounded.cost = kBlockCost * static_cast<float>(blocks_of(leaf.size()));
  if (chooser_) chooser_->find_own_basis(bounded);
}

NodeBases NodeBounder::bound_node(uint32_t count, const BoundedChild* const* child,
                                  BoundedChild& bounded) const {
  // A node has children, which the analyzer cannot know.
  bounded.kdop = child[0]->kdop;  // NOLINT(clang-analyzer-core.NonNullParamChecker)
  for (uint32_t i = 1; i < count; ++i) bounded.kdop.merge(child[i]->kdop);
  if (!chooser_) {
    bounded.cost = kFrameCost;
    return frame_bases(count);
  }
  chooser_->find_own_basis(bounded);
  const NodeBases bases = chooser_->choose(count, child, bounded.area);
  bounded.cost = bases.cost;
  return bases;
}

}  // namespace sobb
