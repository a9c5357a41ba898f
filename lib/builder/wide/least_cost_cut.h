// SPDX-License-Identifier: Apache-2.0
// Which nodes of a binary hierarchy become the children of each wide node: of all choices, one of
// the least cost by the surface area heuristic.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "base/scheduler.h"
#include "builder/array.h"
#include "builder/topology/topology.h"
#include "builder/wide/collapse.h"

namespace sobb {

// By dynamic programming (H. Ylitie et al., "Efficient Incoherent Ray Traversal on GPUs Through
// Compressed Wide BVHs", 2017). With C(n, i) the cost of what lies below node n as a forest of at
// most i trees, and D(n, i) that of it shared out among n's children,
//   D(n, i) = min over 0 < j < i of C(left, j) + C(right, i - j)
//   C(n, 1) = area(n) + D(n, W),   C(n, i) = min(C(n, i - 1), D(n, i)).
// A leaf costs the same in every choice, so nothing. Equal costs go to fewer trees, and to fewer on
// the left.
class LeastCostCut {
 public:
  // Holds 32 bytes a pair of nodes while it lives. Nodes of at most `subtree_limit` references are
  // solved in parallel with what is below them; the costs are the same whatever it is.
  LeastCostCut(const Topology& topology, uint32_t width, uint64_t subtree_limit,
               const Scheduler& scheduler, std::pmr::memory_resource& memory);

  // The children of the wide node that stands for a binary one, in the binary order; of a root that
  // is a leaf itself. Returns their number.
  uint32_t children(const TopologyNode& node, const TopologyNode* child[kMaxWidth]) const;

 private:
  // C by trees, from one on.
  struct Costs {
    float of[kMaxWidth];
  };

  const Costs& costs_of(const TopologyNode& node) const;
  void solve(const TopologyNode& node);
  void solve_subtree(const TopologyNode& root);
  void gather(const TopologyNode& node, uint32_t trees, const TopologyNode* child[kMaxWidth],
              uint32_t& count) const;
  void share(const TopologyNode& node, uint32_t trees, const TopologyNode* child[kMaxWidth],
             uint32_t& count) const;

  const Topology& topology_;
  uint32_t width_;
  double scale_;        // of areas, so that none overflows
  Array<Costs> costs_;  // of the nodes whose children the pairs are
};

}  // namespace sobb
