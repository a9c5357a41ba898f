// SPDX-License-Identifier: Apache-2.0
// Rules choose the bases of a tree's children: one for each child, or one for all children of a
// node.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/scheduler.h"
#include "bounds/bounds_kernels.h"
#include "study/bases/tree.h"
#include "study/report.h"

namespace sobb::study {

enum class BasisFrom {
  kEachChild,       // the least area of the child alone
  kAxes,            // always the axes
  kAverageExtents,  // the least area of a volume with the average of the children's widths (PG26)
  kSumOfAreas,      // the least sum of the children's areas
  kSumOrAxes        // the least sum, or the axes where they are no worse
};

struct BasisRule {
  BasisFrom from;
  sobb_strategy strategy;
  // True where children weigh by the cost of what is below them (surface area heuristic).
  bool weighted;

  std::string name() const;
};

// BasisChooser chooses for a tree whose k-DOPs were fitted with one table.
class BasisChooser {
 public:
  BasisChooser(std::span<const Direction> directions, const Tree& tree,
               const std::vector<Kdop>& kdops, float radius, const Scheduler& scheduler,
               std::pmr::memory_resource& memory);

  // One basis per child.
  std::vector<uint16_t> choose(const BasisRule& rule) const;

 private:
  void find_costs();
  uint16_t choose_own(const Kdop& kdop, sobb_strategy strategy, float& area) const;
  uint16_t choose_shared(const Tree::Node& node, const BasisRule& rule) const;
  float weight(uint32_t child, const BasisRule& rule) const;

  const Tree& tree_;
  const std::vector<Kdop>& kdops_;
  const Scheduler& scheduler_;
  const BoundsKernels& kernels_;
  BasisTable table_;
  float scale_;
  std::vector<float> cost_;  // of visiting a child, in node tests
};

}  // namespace sobb::study
