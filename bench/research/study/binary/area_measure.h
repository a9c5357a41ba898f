// SPDX-License-Identifier: Apache-2.0
// AreaMeasure gives the areas by which hierarchies are chosen: those of the AABB or the SOBB of a
// k-DOP.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis_table.h"
#include "bounds/bounds_kernels.h"
#include "builder/mesh.h"
#include "study/binary/binary_tree.h"

namespace sobb::study {

// Holds the k-DOP of every triangle. It has the library's defaults: k = 64, and k^2 chooses the
// basis.
class AreaMeasure {
 public:
  AreaMeasure(const Mesh& mesh, const MeshSummary& summary, std::pmr::memory_resource& memory);

  const Kdop& kdop(const Reference& reference) const { return kdops_[reference.primitive]; }
  uint32_t direction_count() const { return directions_.count; }

  // The area, divided by the squared radius of the scene. The AABB consists of the k-DOP's first
  // three slabs, which are along the axes.
  float area(sobb_volume volume, const Kdop& kdop) const;

  float area_in(uint16_t basis, const Kdop& kdop) const;
  // The basis with the least weighted sum of areas.
  uint16_t shared_basis(std::span<const Kdop* const> kdops, const float* weights) const;

  // One value for every node of a tree.
  std::vector<float> areas(sobb_volume volume, const BinaryTree& tree) const;
  std::vector<Kdop> kdops(const BinaryTree& tree) const;

 private:
  // Calls visit(node, k-DOP) from the last node to the first.
  template <class Visit>
  void each_kdop(const BinaryTree& tree, const Visit& visit) const;

  DirectionTable directions_;
  BasisTable table_;
  const BoundsKernels& kernels_;
  float scale_;
  std::vector<Kdop> kdops_;  // one per triangle
};

}  // namespace sobb::study
