// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/morton_topology.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "builder/topology/morton_cells.h"
#include "builder/topology/treetop.h"

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 14;
// Cells are joined to subtrees of at most 1/kSubtreeParts of the references, within these bounds:
// enough subtrees to share among threads, each small enough for a cache. Larger ones make builds
// slower and rays faster.
constexpr uint64_t kSubtreeParts = 16;
constexpr uint64_t kLeastSubtree = 1 << 11;
constexpr uint64_t kMostSubtree = 1 << 14;
// A cell of more references is sorted into a grid of its own.
constexpr uint64_t kLargeCell = 1 << 14;
// Nodes of at most this many references are split in the middle. A larger number makes builds
// faster and rays slower (docs/experiments.md).
constexpr uint64_t kMiddleCount = 256;
// The share of the progress that the top takes, by measured time.
constexpr double kTopShare = 0.25;

class MortonBuilder {
 public:
  MortonBuilder(const Mesh& mesh, const SahKernels& kernels, const Scheduler& scheduler,
                Memory& memory, const Frame& frame)
      : mesh_(mesh),
        kernels_(kernels),
        scheduler_(scheduler),
        memory_(memory),
        frame_(frame),
        subtree_references_(
            std::clamp(mesh.triangle_count() / kSubtreeParts, kLeastSubtree, kMostSubtree)),
        triangles_(mesh.triangle_count(), memory),
        top_(memory) {
    scheduler.for_ranges(triangles_.size(), kGrain, [&](uint64_t begin, uint64_t end) {
      std::iota(triangles_.data() + begin, triangles_.data() + end, static_cast<uint32_t>(begin));
    });
  }

  void make_top(Progress& progress, double progress_end) {
    std::pmr::vector<Group> groups(&memory_);
    add({0, triangles_.size(), {}, 0}, subtree_references_, groups);
    while (!groups.empty()) {
      progress.check(0, progress_end, 0);
      const Group group = groups.back();
      groups.pop_back();
      const MortonCells cells = sort_into_cells(
          mesh_, frame_, {triangles_.data() + group.begin, group.count}, scheduler_, memory_);
      if (cells.is_one()) {
        add_subtree(group);
      } else {
        add_cells(cells, 0, cells.count(), group, groups);
      }
    }
  }

  void make_subtrees(Progress& progress, double progress_begin, double progress_end) {
    const std::span<SahSubtree> subtrees = top_.subtrees();
    std::atomic<uint64_t> done{0};
    scheduler_.for_each(subtrees.size(), [&](uint64_t i) {
      progress.check(progress_begin, progress_end,
                     static_cast<double>(done) / static_cast<double>(subtrees.size()));
      make_subtree(subtrees[i]);
      ++done;
    });
    top_.bound();
  }

  BinaryNodes collect() {
    BinaryNodes nodes;
    nodes.pairs = top_.collect(scheduler_, nodes.root);
    nodes.primitives = std::move(triangles_);
    return nodes;
  }

 private:
  // A node of the top, by its triangles, which lie together.
  struct Group {
    uint64_t begin;
    uint64_t count;
    Treetop::Place place;
    uint32_t depth;  // nodes above it
  };

  // Makes the node of the cells from `first` to `last` - 1, a box of the grid that `all` was sorted
  // into. Only place and depth of `all` are the node's own.
  void add_cells(const MortonCells& cells, uint64_t first, uint64_t last, const Group& all,
                 std::pmr::vector<Group>& groups) {
    const std::pmr::vector<uint64_t>& begin = cells.begin;
    const uint64_t count = begin[last] - begin[first];
    while (count > subtree_references_ && last - first > 1) {
      const uint64_t middle = (first + last) / 2;
      if (begin[middle] == begin[first]) {
        first = middle;
      } else if (begin[middle] == begin[last]) {
        last = middle;
      } else {
        const uint32_t pair = top_.add_pair(all.place, {});
        add_cells(cells, first, middle, {all.begin, all.count, {pair, 0}, all.depth + 1}, groups);
        add_cells(cells, middle, last, {all.begin, all.count, {pair, 1}, all.depth + 1}, groups);
        return;
      }
    }
    add({all.begin + begin[first], count, all.place, all.depth}, kLargeCell, groups);
  }

  // Makes a group a subtree, or where it has more references than `most`, leaves it to the next
  // grid. A grid's levels must not take the depth that the subtrees' need below them.
  void add(const Group& group, uint64_t most, std::pmr::vector<Group>& groups) {
    if (group.count > most && group.depth + kMostCellLevels <= kDeepestSplit) {
      groups.push_back(group);
    } else {
      add_subtree(group);
    }
  }

  void add_subtree(const Group& group) {
    SahSubtree& subtree = top_.add_subtree(group.place, {SahExtent::nothing(), 0, group.count, 0});
    subtree.depth = group.depth;
    subtree.primitives = triangles_.data();
    subtree.first = group.begin;
    subtree.middle_count = kMiddleCount;
  }

  void make_subtree(SahSubtree& subtree) const {
    SahNode& node = subtree.node;
    Array<SahReference> references(2 * node.count, memory_);
    const uint32_t* triangles = triangles_.data() + subtree.first;
    for (uint64_t i = 0; i < node.count; ++i) {
      references[i] = SahReference::whole(box_of(mesh_, triangles[i], frame_), triangles[i]);
    }
    kernels_.bound(references.data(), node.count, node.extent);
    subtree.at[0] = references.data();
    subtree.at[1] = references.data() + node.count;
    kernels_.build(subtree);
  }

  const Mesh& mesh_;
  const SahKernels& kernels_;
  const Scheduler& scheduler_;
  Memory& memory_;
  const Frame& frame_;
  const uint64_t subtree_references_;
  Array<uint32_t> triangles_;  // becomes the references of the leaves
  Treetop top_;
};

}  // namespace

BinaryNodes morton_topology(const Mesh& mesh, const SahKernels& kernels, const Scheduler& scheduler,
                            Memory& memory, Progress& progress, double progress_end,
                            const Frame& frame) {
  const double top_end = kTopShare * progress_end;
  MortonBuilder builder(mesh, kernels, scheduler, memory, frame);
  builder.make_top(progress, top_end);
  builder.make_subtrees(progress, top_end, progress_end);
  return builder.collect();
}

}  // namespace sobb
