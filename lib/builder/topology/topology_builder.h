// SPDX-License-Identifier: Apache-2.0
// The topology from the top down: large nodes by parallel loops over their references, a level at a
// time; then the subtrees below them, each by one thread.
#pragma once

#include <memory_resource>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder/sah/sah_kernels.h"

namespace sobb {

// What a topology is made from and into.
struct SahBuild {
  SahReference* references[2];  // two arrays with room for all, which are in the first
  uint64_t count;
  uint64_t room;         // for more of them
  uint32_t* primitives;  // receives what is in leaves; room likewise
  Box* boxes = nullptr;  // likewise; none: no spatial splits
  const Mesh& mesh;
  const Frame& frame;
};

class TopologyBuilder {
 public:
  TopologyBuilder(const SahBuild& build, const SahKernels& kernels, const Scheduler& scheduler,
                  Memory& memory)
      : build_(build),
        cutting_{build.mesh, build.frame, 0},
        kernels_(kernels),
        scheduler_(scheduler),
        memory_(memory),
        top_(&memory),
        subtrees_(&memory) {}

  // Makes all nodes; the references are spent.
  void build(Progress& progress, double progress_begin, double progress_end);

  // Collects them, depth first.
  Array<NodePair> collect(TopologyNode& root) const;

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFF;

  // A node of the top under way, the child of another.
  struct Open {
    SahNode node;
    uint32_t parent;  // in top_; kNone: the root
    uint32_t side;
    Split split{};       // the best so far
    Split trial{};       // one that may be better
    SahNode child[2]{};  // of the best
    uint64_t first_block = 0;
    uint64_t block_count = 0;
  };
  // References of such a node that one task bins and moves.
  struct Block {
    uint32_t open;
    uint64_t begin;
    uint64_t count;
    uint64_t placed[2] = {0, 0};  // how many go to either side
    uint64_t trial[2] = {0, 0};   // likewise, by the trial
    SahReference* to[2] = {};     // where they go
    // What they are there.
    SahExtent extent[2] = {SahExtent::nothing(), SahExtent::nothing()};
  };
  using Level = std::pmr::vector<Open>;
  using Blocks = std::pmr::vector<Block>;

  // Two nodes of the top, or where subtrees hang.
  struct TopPair {
    NodePair nodes;
    uint32_t subtree[2] = {kNone, kNone};
  };

  SahNode bound_all() const;
  void split_level(Level& level, int from) const;
  void try_splits(SplitKind kind, Level& level, Blocks& blocks, int from) const;
  void try_split(Open& open, const Bins* bins) const;
  void count_sides(const Open& open, const Bins& bins, Block& block, int from) const;
  static void adopt_trial(Open& open, Block* blocks);
  void place(Open& open, Block* blocks, int to) const;
  const Cutting* cutting() const { return build_.boxes == nullptr ? nullptr : &cutting_; }
  void add_subtree(const Open& open, uint32_t depth, int from);
  void add_children(const Open& open, Level& next);
  uint64_t place(uint32_t top, uint64_t at, Array<NodePair>& pairs,
                 std::pmr::vector<uint64_t>& places) const;

  SahBuild build_;
  Cutting cutting_;
  const SahKernels& kernels_;
  const Scheduler& scheduler_;
  Memory& memory_;
  TopologyNode root_{};
  std::pmr::vector<TopPair> top_;
  std::pmr::vector<SahSubtree> subtrees_;
};

}  // namespace sobb
