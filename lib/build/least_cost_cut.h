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
  // The root, which is no leaf, is a wide node's. Holds about 150 bytes a node while it lives.
  LeastCostCut(const TopologyNode& root, uint32_t width, std::pmr::memory_resource& memory);

  static constexpr uint32_t kRoot = 0;

  // The children of the wide node that stands for a binary one, in the binary order; `place` are
  // theirs, to ask with for what lies below them.
  uint32_t children(uint32_t at, const TopologyNode* child[kMaxWidth],
                    uint32_t place[kMaxWidth]) const;

 private:
  struct Shares {
    uint8_t left = 0;  // trees of the left child; none: the node itself is a tree
    uint8_t right = 0;
  };
  struct Binary {
    const TopologyNode* node;
    double area;
    uint32_t child[2];
    double cost[kMaxWidth + 1];    // C, by trees
    Shares shares[kMaxWidth + 1];  // how the node is shared out at that cost
    Shares opened;                 // as a wide node's root
  };

  void solve(Binary& binary) const;
  void gather(uint32_t at, Shares shares, const TopologyNode* child[kMaxWidth],
              uint32_t place[kMaxWidth], uint32_t& count) const;

  uint32_t width_;
  std::pmr::vector<Binary> binary_;  // parents before their children
};

}  // namespace sobb
