// SPDX-License-Identifier: Apache-2.0
// Chooses the nodes of a binary hierarchy that become the children of each wide node: of all
// choices one of the least cost by the surface area heuristic.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "base/scheduler.h"
#include "builder/array.h"
#include "builder/topology/topology.h"
#include "builder/wide/wide_topology.h"

namespace sobb {

// The choice is made by dynamic programming (H. Ylitie et al., "Efficient Incoherent Ray Traversal
// on GPUs Through Compressed Wide BVHs", 2017). C(n, i) is the least cost of the subtree of node n
// as a forest of at most i trees, D(n, i) the same where n itself is no root of the forest, so that
// n's children share the i trees:
//   D(n, i) = min over 0 < j < i of C(left, j) + C(right, i - j)
//   C(n, 1) = area(n) + D(n, W),   C(n, i) = min(C(n, i - 1), D(n, i)).
// A leaf costs the same in every choice, so it counts nothing. Of equal costs the one with fewer
// trees is taken, then the one with fewer trees on the left.
class LeastCostCut {
 public:
  // Holds 32 bytes per pair of nodes. Subtrees of at most `subtree_limit` references are solved in
  // parallel, each by one thread; the costs do not depend on the limit.
  LeastCostCut(const Topology& topology, uint32_t width, uint64_t subtree_limit,
               const Scheduler& scheduler, std::pmr::memory_resource& memory);

  // Finds the children of the wide node that stands for a binary one, in the binary order, and
  // returns their number. A root that is a leaf is its own only child.
  uint32_t children(const TopologyNode& node, const TopologyNode* child[kMaxWidth]) const;

 private:
  struct Costs {
    float of[kMaxWidth];  // of[i - 1] is C(n, i)
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
  double scale_;        // makes areas relative to the root's, so that none overflows
  Array<Costs> costs_;  // costs_[i] are the costs of the parent of pair i
};

}  // namespace sobb
