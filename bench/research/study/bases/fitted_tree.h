// SPDX-License-Identifier: Apache-2.0
// A tree of a scene with the k-DOPs of its children, for which rules choose bases.
#pragma once

#include <span>
#include <vector>

#include "study/bases/basis_rules.h"
#include "study/bases/counting_trace.h"
#include "study/study_scene.h"

namespace sobb::study {

class FittedTree {
 public:
  // Collapses the topology to nodes of `width` children and fits a k-DOP to each child. The scene
  // is borrowed.
  FittedTree(StudyScene& scene, const Topology& topology, uint32_t width,
             std::span<const Direction> directions);
  FittedTree(const FittedTree&) = delete;
  FittedTree& operator=(const FittedTree&) = delete;

  size_t node_count() const { return tree_.nodes.size(); }
  std::vector<uint16_t> choose(const BasisRule& rule) const { return chooser_.choose(rule); }
  AreaSums areas(const std::vector<uint16_t>& bases) const;
  // The tree whose children have volumes in these bases, which it borrows.
  BoundedTree bounded(const std::vector<uint16_t>& bases) const;

 private:
  const StudyScene& scene_;
  DirectionTable directions_;
  Tree tree_;
  std::vector<Kdop> kdops_;
  BasisChooser chooser_;
};

}  // namespace sobb::study
