// SPDX-License-Identifier: Apache-2.0
#include "area_measure.h"

#include "base/isa.h"
#include "build/leaf.h"

namespace sobb::study {

AreaMeasure::AreaMeasure(const Mesh& mesh, const MeshSummary& summary,
                         std::pmr::memory_resource& memory)
    : directions_(make_direction_table(default_directions(64))),
      table_(default_directions(64), memory),
      kernels_(bounds_kernels(resolve_isa(SOBB_ISA_BEST))),
      scale_(summary.radius > 0 ? 1 / summary.radius : 1),
      kdops_(mesh.triangle_count()) {
  const float centre[3] = {summary.centre.x, summary.centre.y, summary.centre.z};
  for (uint32_t i = 0; i < kdops_.size(); ++i) {
    const Reference reference{Corners(mesh, i).box(), i};
    const LeafNode leaf{{1, true}, &reference};
    fit_leaf(mesh, leaf, directions_, centre, kernels_, kdops_[i]);
  }
}

float AreaMeasure::area(sobb_volume volume, const Kdop& kdop) const {
  alignas(64) float width[kMaxDirections];
  for (uint32_t k = 0; k < kMaxDirections; ++k) {
    width[k] = (kdop.upper[k] - kdop.lower[k]) * scale_;
  }
  if (volume == SOBB_VOLUME_AABB) {
    return 2 * (width[0] * width[1] + width[1] * width[2] + width[2] * width[0]);
  }
  return kernels_.choose_one(table_, width, SOBB_STRATEGY_K2).area;
}

Kdop AreaMeasure::bound(const BinaryTree& tree, const BinaryNode& leaf) const {
  Kdop result = kdop(tree.references[leaf.first]);
  for (uint32_t i = 1; i < leaf.count; ++i) result.merge(kdop(tree.references[leaf.first + i]));
  return result;
}

std::vector<float> AreaMeasure::areas(sobb_volume volume, const BinaryTree& tree) const {
  std::vector<float> result(tree.nodes.size());
  // From the last node to the first, both children of a node have been met just before it.
  std::vector<Kdop> met;
  for (size_t at = tree.nodes.size(); at-- > 0;) {
    const BinaryNode& node = tree.nodes[at];
    if (node.is_leaf()) {
      met.push_back(bound(tree, node));
    } else {
      const Kdop first = met.back();
      met.pop_back();
      met.back().merge(first);
    }
    result[at] = area(volume, met.back());
  }
  return result;
}

}  // namespace sobb::study
