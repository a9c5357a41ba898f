// SPDX-License-Identifier: Apache-2.0
// Which nodes of a binary subtree become the children of each wide node: of all choices, one of the
// least cost by the surface area heuristic.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "build/collapse.h"
#include "build/topology.h"

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
  // The root, which is no leaf, is a wide node's. Holds 32 bytes a pair of nodes while it lives.
  LeastCostCut(const Topology& topology, const TopologyNode& root, uint32_t width,
               std::pmr::memory_resource& memory);

  // The children of the wide node that stands for a binary one, in the binary order. Returns their
  // number.
  uint32_t children(const TopologyNode& node, const TopologyNode* child[kMaxWidth]) const;

 private:
  // C by trees, from one on.
  struct Costs {
    float of[kMaxWidth];
  };

  const Costs& costs(const TopologyNode& node) const;
  void solve(const TopologyNode& node, Costs& costs) const;
  void gather(const TopologyNode& node, uint32_t trees, const TopologyNode* child[kMaxWidth],
              uint32_t& count) const;
  void share(const TopologyNode& node, uint32_t trees, const TopologyNode* child[kMaxWidth],
             uint32_t& count) const;

  const Topology& topology_;
  uint32_t width_;
  uint32_t first_;                 // pair
  double scale_;                   // of areas, so that none overflows
  std::pmr::vector<Costs> costs_;  // of the nodes whose children the pairs are
};

}  // namespace sobb
