// SPDX-License-Identifier: Apache-2.0
#include "study/binary/area_measure.h"

#include "base/isa.h"
#include "builder/volumes/leaf_kdop.h"

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
    fit_leaf(mesh, {{&i, 1}, {}}, directions_, centre, kernels_, kdops_[i]);
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

float AreaMeasure::area_in(uint16_t basis, const Kdop& kdop) const {
  float width[3];
  for (int j = 0; j < 3; ++j) {
    const uint32_t k = basis_direction(basis, j);
    width[j] = (kdop.upper[k] - kdop.lower[k]) * scale_;
  }
  const float* inverse =
      table_.inverse_determinants(basis_direction(basis, 0), basis_direction(basis, 1));
  return 2 * (width[0] * width[1] + width[1] * width[2] + width[2] * width[0]) *
         inverse[basis_direction(basis, 2)];
}

uint16_t AreaMeasure::shared_basis(std::span<const Kdop* const> kdops, const float* weights) const {
  Gram gram = {};
  for (size_t i = 0; i < kdops.size(); ++i) {
    kernels_.add_to_gram(*kdops[i], scale_, weights[i], gram);
  }
  return kernels_.choose(table_, gram, SOBB_STRATEGY_K2).basis;
}

template <class Visit>
void AreaMeasure::each_kdop(const BinaryTree& tree, const Visit& visit) const {
  // In this order both children of a node come just before it, so their k-DOPs are on the stack.
  std::vector<Kdop> stack;
  for (size_t at = tree.nodes.size(); at-- > 0;) {
    const BinaryNode& node = tree.nodes[at];
    if (node.is_leaf()) {
      stack.push_back(kdop(tree.references[node.first]));
      for (uint32_t i = 1; i < node.count; ++i) {
        stack.back().merge(kdop(tree.references[node.first + i]));
      }
    } else {
      const Kdop first = stack.back();
      stack.pop_back();
      stack.back().merge(first);
    }
    visit(at, stack.back());
  }
}

std::vector<float> AreaMeasure::areas(sobb_volume volume, const BinaryTree& tree) const {
  std::vector<float> result(tree.nodes.size());
  each_kdop(tree, [&](size_t at, const Kdop& kdop) { result[at] = area(volume, kdop); });
  return result;
}

std::vector<Kdop> AreaMeasure::kdops(const BinaryTree& tree) const {
  std::vector<Kdop> result(tree.nodes.size());
  each_kdop(tree, [&](size_t at, const Kdop& kdop) { result[at] = kdop; });
  return result;
}

}  // namespace sobb::study
