// SPDX-License-Identifier: Apache-2.0
// The areas that hierarchies are chosen by: of the AABB, or of the SOBB, of what a k-DOP bounds.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "bounds/basis_table.h"
#include "bounds/bounds_kernels.h"
#include "builder/mesh.h"
#include "study/binary/binary_tree.h"

namespace sobb::study {

// Holds the k-DOP of every triangle: k = 64, basis by strategy k^2, as the library's defaults are.
class AreaMeasure {
 public:
  AreaMeasure(const Mesh& mesh, const MeshSummary& summary, std::pmr::memory_resource& memory);

  const Kdop& kdop(const Reference& reference) const { return kdops_[reference.primitive]; }
  uint32_t direction_count() const { return directions_.count; }

  // Over the squared radius of the scene. Of the AABB: of the k-DOP's first three slabs, which are
  // along the axes.
  float area(sobb_volume volume, const Kdop& kdop) const;

  float area_in(uint16_t basis, const Kdop& kdop) const;
  // The basis of the least sum of areas, each by its weight.
  uint16_t shared_basis(std::span<const Kdop* const> kdops, const float* weights) const;

  // Of every node of a tree.
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
  std::vector<Kdop> kdops_;  // by triangle
};

}  // namespace sobb::study
