// SPDX-License-Identifier: Apache-2.0
// The topology from the top down: large nodes by parallel loops over their references, a level at a
// time; then the subtrees below them, each by one thread.
#pragma once

#include <memory_resource>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "build/sah_kernels.h"

namespace sobb {

class TopologyBuilder {
 public:
  // Both arrays have room for all references, which are in the first. `primitives` likewise;
  // it receives what is in leaves.
  TopologyBuilder(SahReference* references, SahReference* other, uint64_t count,
                  uint32_t* primitives, const SahKernels& kernels, const Scheduler& scheduler,
                  Memory& memory)
      : at_{references, other},
        count_(count),
        primitives_(primitives),
        kernels_(kernels),
        scheduler_(scheduler),
        memory_(memory),
        top_(&memory),
        subtrees_(&memory) {}

  // Makes all nodes; the references are spent. Progress runs to `progress_end`.
  void build(Progress& progress, double progress_end);

  // Collects them, depth first.
  Array<NodePair> collect(TopologyNode& root) const;

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFF;

  // A node of the top under way, the child of another.
  struct Open {
    SahNode node;
    uint32_t parent;  // in top_; kNone: the root
    uint32_t side;
    Binning binning{};
    Split split{};
    Centres centres[2]{};  // of both sides
    uint64_t first_block = 0;
    uint64_t block_count = 0;
  };
  // References of such a node that one task bins and moves.
  struct Block {
    uint32_t open;
    uint64_t begin;
    uint64_t count;
    SahReference* left = nullptr;  // where they go
    SahReference* right = nullptr;
    Centres centres[2] = {Centres::nothing(), Centres::nothing()};
  };
  // Two nodes of the top, or where subtrees hang.
  struct TopPair {
    NodePair nodes;
    uint32_t subtree[2] = {kNone, kNone};
  };

  SahNode bound_all() const;
  void split_level(std::pmr::vector<Open>& level, int from) const;
  void find_split(Open& open, const Bins* bins, Block* blocks, int to) const;
  void add_subtree(const Open& open, uint32_t depth, int from);
  void add_children(const Open& open, std::pmr::vector<Open>& next);
  uint64_t place(uint32_t top, uint64_t at, Array<NodePair>& pairs,
                 std::pmr::vector<uint64_t>& places) const;

  SahReference* at_[2];
  uint64_t count_;
  uint32_t* primitives_;
  const SahKernels& kernels_;
  const Scheduler& scheduler_;
  Memory& memory_;
  TopologyNode root_{};
  std::pmr::vector<TopPair> top_;
  std::pmr::vector<SahSubtree> subtrees_;
};

}  // namespace sobb
