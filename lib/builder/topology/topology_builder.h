// SPDX-License-Identifier: Apache-2.0
// Builds a topology from the top down: large nodes by parallel loops over their references, one
// level at a time; then the subtrees below them, each by one thread.
#pragma once

#include <memory_resource>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/scheduler.h"
#include "builder/array.h"
#include "builder/sah/sah_kernels.h"
#include "builder/topology/treetop.h"

namespace sobb {

// What a topology is made from, and where its leaves' references go.
struct SahBuild {
  SahReference* references[2];  // two arrays of count + room; the first holds the references
  uint64_t count;
  uint64_t room;  // for the references that spatial splits add
  // Arrays of count + room that receive the references in leaves, as struct References has them.
  uint32_t* primitives;
  Box* cuts;  // null: no spatial splits
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
        top_(memory) {}

  // Makes all nodes, and overwrites the references.
  void build(Progress& progress, double progress_begin, double progress_end);

  // Collects the nodes, depth first.
  Array<NodePair> collect(TopologyNode& root) const { return top_.collect(scheduler_, root); }

 private:
  // A node of the top that is still to be split.
  struct TopNode {
    SahNode node;
    Treetop::Place place;
    Split split{};       // the best so far
    Split trial{};       // one that may be better
    SahNode child[2]{};  // the sides of `split`
    uint64_t first_chunk = 0;
    uint64_t chunk_count = 0;
  };
  // References of a top node that one task bins and moves.
  struct ReferenceChunk {
    uint32_t node;  // in its level
    uint64_t begin;
    uint64_t count;
    uint64_t placed[2] = {0, 0};  // references that the node's split puts on either side
    uint64_t trial[2] = {0, 0};   // the same of the node's trial
    SahReference* to[2] = {};     // where the references of either side go
    // The extents of the references that go to either side.
    SahExtent extent[2] = {SahExtent::nothing(), SahExtent::nothing()};
  };
  using Level = std::pmr::vector<TopNode>;
  using Chunks = std::pmr::vector<ReferenceChunk>;

  SahNode bound_all() const;
  void split_level(Level& level, int from) const;
  void try_splits(SplitKind kind, Level& level, Chunks& chunks, int from) const;
  void try_split(TopNode& top, const Bins* bins) const;
  void count_sides(const TopNode& top, const Bins& bins, ReferenceChunk& chunk, int from) const;
  static void adopt_trial(TopNode& top, ReferenceChunk* chunks);
  void place_references(TopNode& top, ReferenceChunk* chunks, int to) const;
  const Cutting* cutting() const { return build_.cuts == nullptr ? nullptr : &cutting_; }
  void add_subtree(const TopNode& top, uint32_t depth, int from);
  void add_children(const TopNode& top, Level& next);

  SahBuild build_;
  Cutting cutting_;
  const SahKernels& kernels_;
  const Scheduler& scheduler_;
  Memory& memory_;
  Treetop top_;
};

}  // namespace sobb
