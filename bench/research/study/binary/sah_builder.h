// SPDX-License-Identifier: Apache-2.0
// SahBuilder builds a binary hierarchy from the top down, by the binned surface area heuristic (I.
// Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, 2007) over the areas of any
// volume.
#pragma once

#include <optional>
#include <span>

#include "bounds/area.h"
#include "builder/boxes/references.h"
#include "study/binary/area_measure.h"

namespace sobb::study {

struct SahSettings {
  sobb_volume volume = SOBB_VOLUME_SOBB;  // a side costs the area of this
  uint32_t directions = 3;                // centroids are binned along so many of the table
  bool fibres = false;                    // tries two clusters by orientation, too
  // The most triangles of a leaf that the heuristic may prefer to a split. 1: leaves are chosen
  // later.
  uint32_t leaf_limit = kMaxLeafReferences;
};

class SahBuilder {
 public:
  // `tangents` has one value per triangle, or is empty without fibres. Measure and tangents are
  // borrowed.
  SahBuilder(const AreaMeasure& measure, const std::vector<Vector>& tangents,
             const SahSettings& settings)
      : measure_(measure), tangents_(tangents), settings_(settings) {}

  // Builds the nodes over the tree's references, whose order it changes.
  void build(BinaryTree& tree) const;

  // Copies the tree and splits each of its leaves as if it were a tree.
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
