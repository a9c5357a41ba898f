// SPDX-License-Identifier: Apache-2.0
// The pairs of a topology that lie above its subtrees, while the subtrees are made.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/scheduler.h"
#include "builder/array.h"
#include "builder/sah/sah_kernels.h"

namespace sobb {

class Treetop {
 public:
  // A node's place: a side of a pair, or the root.
  struct Place {
    static constexpr uint32_t kRoot = 0xFFFFFFFF;

    uint32_t pair = kRoot;
    uint32_t side = 0;
  };

  explicit Treetop(Memory& memory) : memory_(memory), pairs_(&memory), subtrees_(&memory) {}

  // Makes the node at a place an inner node, and returns its pair.
  uint32_t add_pair(Place place, const Box& box);

  // Makes the node at a place a subtree's root.
  SahSubtree& add_subtree(Place place, const SahNode& node);

  std::span<SahSubtree> subtrees() { return subtrees_; }

  // Gives inner nodes the boxes of what lies below them, once the subtrees are made.
  void bound();

  // Collects the nodes, depth first.
  Array<NodePair> collect(const Scheduler& scheduler, TopologyNode& root) const;

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFF;

  struct Pair {
    NodePair nodes;
    uint32_t subtree[2] = {kNone, kNone};  // of which a node is the root
  };

  Box box_below(uint32_t pair) const;
  uint64_t place_pair(uint32_t pair, uint64_t at, Array<NodePair>& pairs,
                      std::pmr::vector<uint64_t>& places) const;

  Memory& memory_;
  TopologyNode root_{};
  std::pmr::vector<Pair> pairs_;  // parents before their children
  std::pmr::vector<SahSubtree> subtrees_;
};

}  // namespace sobb
