// SPDX-License-Identifier: Apache-2.0
// A binary hierarchy from the top down, by the binned surface area heuristic over areas of one's
// choice (I. Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007).
#pragma once

#include <optional>
#include <span>

#include "bounds/area.h"
#include "study/binary/area_measure.h"

namespace sobb::study {

struct SahSettings {
  sobb_volume volume = SOBB_VOLUME_SOBB;  // whose area a side costs
  uint32_t directions = 3;                // of the table: centroids are binned along the first ones
  bool fibres = false;                    // two clusters by orientation are tried, too
  // Triangles of a leaf at most, where the heuristic prefers one. 1: leaves are chosen later.
  uint32_t leaf_limit = kMaxLeafReferences;
};

class SahBuilder {
 public:
  // `tangents` are of all triangles, or empty without fibres. All are borrowed.
  SahBuilder(const AreaMeasure& measure, const std::vector<Vector>& tangents,
             const SahSettings& settings)
      : measure_(measure), tangents_(tangents), settings_(settings) {}

  // Over the tree's references, whose order it changes.
  void build(BinaryTree& tree) const;

  // The tree with its leaves split further, each as if it were a tree.
  BinaryTree split_leaves(const BinaryTree& tree) const;

 private:
  // Two sides, told apart by the bin of a centroid or by a cluster of orientation.
  struct Split;

  uint32_t add(BinaryTree& tree, uint32_t first, uint32_t count, uint32_t depth) const;
  uint32_t copy(const BinaryTree& from, uint32_t node, BinaryTree& tree, uint32_t depth) const;
  Split find(std::span<const Reference> references) const;
  void try_direction(std::span<const Reference> references, uint32_t direction, float begin,
                     float scale, Split& best) const;
  void try_fibres(std::span<const Reference> references, Split& best) const;
  bool is_second(const Split& split, const Reference& reference) const;

  const AreaMeasure& measure_;
  const std::vector<Vector>& tangents_;
  SahSettings settings_;
};

}  // namespace sobb::study
