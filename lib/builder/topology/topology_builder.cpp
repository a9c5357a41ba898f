// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/topology_builder.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace sobb {
namespace {

constexpr uint64_t kBlock = 1 << 14;  // references
// A subtree has at most this part of the references, or this many: enough subtrees to share among
// threads, each small enough for a cache.
constexpr uint64_t kSubtreeParts = 256;
constexpr uint64_t kSubtreeReferences = 4096;
// The part of the progress in which the top is made, by measured time.
constexpr double kTopShare = 0.4;
// The part of the root's area that the sides of a split must have in common before a spatial one is
// tried, as in Stich et al.
constexpr double kLeastOverlap = 1e-5;

}  // namespace

void TopologyBuilder::build(Progress& progress, double progress_begin, double progress_end) {
  const double progress_of_top = progress_begin + (progress_end - progress_begin) * kTopShare;
  const uint64_t limit = std::max(kSubtreeReferences, build_.count / kSubtreeParts);
  Level level({{bound_all(), kNone, 0}}, &memory_);
  cutting_.least_overlap = level[0].node.extent.box.box().half_area() * kLeastOverlap;
  for (uint32_t depth = 0; !level.empty(); ++depth) {
    // A root's children are half as large, and so on: so many levels are nearly all.
    progress.check(progress_begin, progress_of_top, std::min(1.0, depth / 10.0));
    const int from = static_cast<int>(depth % 2);
    Level large(&memory_);
    for (const Open& open : level) {
      if (open.node.count <= limit || depth >= kDeepestSplit) {
        add_subtree(open, depth, from);
      } else {
        large.push_back(open);
      }
    }
    split_level(large, from);
    level.clear();
    for (const Open& open : large) {
      if (open.split.axis < 0) {
        add_subtree(open, depth, from);
      } else {
        add_children(open, level);
      }
    }
  }
  std::atomic<uint64_t> done{0};
  scheduler_.for_each(subtrees_.size(), [&](uint64_t i) {
    progress.check(progress_of_top, progress_end,
                   static_cast<double>(done) / static_cast<double>(subtrees_.size()));
    kernels_.build(subtrees_[i]);
    ++done;
  });
}

SahNode TopologyBuilder::bound_all() const {
  std::pmr::vector<SahExtent> parts((build_.count + kBlock - 1) / kBlock, &memory_);
  scheduler_.for_ranges(build_.count, kBlock, [&](uint64_t begin, uint64_t end) {
    SahExtent& part = parts[begin / kBlock];
    part = SahExtent::nothing();
    kernels_.bound(build_.references[0] + begin, end - begin, part);
  });
  SahNode node = {parts[0], 0, build_.count, build_.room};
  for (const SahExtent& part : parts) node.extent.grow(part);
  return node;
}

// Moves the references of all nodes of a level to the other array, for those that have a split.
void TopologyBuilder::split_level(Level& level, int from) const {
  Blocks blocks(&memory_);
  for (Open& open : level) {
    open.first_block = blocks.size();
    open.block_count = (open.node.count + kBlock - 1) / kBlock;
    for (uint64_t i = 0; i < open.block_count; ++i) {
      blocks.push_back({static_cast<uint32_t>(&open - level.data()), open.node.begin + i * kBlock,
                        std::min(kBlock, open.node.count - i * kBlock)});
    }
  }
  for (const SplitKind kind : kSplitKinds) try_splits(kind, level, blocks, from);
  for (Open& open : level) {
    if (open.split.axis >= 0) place(open, &blocks[open.first_block], 1 - from);
  }
  scheduler_.for_each(blocks.size(), [&](uint64_t i) {
    Block& block = blocks[i];
    const Open& open = level[block.open];
    if (open.split.axis < 0) return;
    kernels_.partition(build_.references[from] + block.begin, block.count, open.node, open.split,
                       cutting(), block.to[0], block.to[1], block.extent);
  });
  for (Open& open : level) {
    for (int side = 0; side < 2; ++side) {
      for (uint64_t i = 0; i < open.block_count; ++i) {
        open.child[side].extent.grow(blocks[open.first_block + i].extent[side]);
      }
    }
  }
}

// Looks for a better split of each node, of another kind.
void TopologyBuilder::try_splits(SplitKind kind, Level& level, Blocks& blocks, int from) const {
  bool any = false;
  for (Open& open : level) {
    open.trial = {};
    open.trial.binning = make_binning(kind, open.node, open.split, cutting());
    any |= open.trial.binning.count > 0;
  }
  if (!any) return;
  Array<Bins> bins(blocks.size(), memory_);
  scheduler_.for_each(blocks.size(), [&](uint64_t i) {
    const Binning& binning = level[blocks[i].open].trial.binning;
    if (binning.count == 0) return;
    kernels_.clear(bins[i], binning);
    kernels_.bin(build_.references[from] + blocks[i].begin, blocks[i].count, binning, cutting(),
                 bins[i]);
  });
  scheduler_.for_each(level.size(), [&](uint64_t i) {
    if (level[i].trial.binning.count > 0) try_split(level[i], &bins[level[i].first_block]);
  });
  scheduler_.for_each(blocks.size(), [&](uint64_t i) {
    const Open& open = level[blocks[i].open];
    if (open.trial.axis >= 0) count_sides(open, bins[i], blocks[i], from);
  });
  for (Open& open : level) {
    if (open.trial.axis >= 0) adopt_trial(open, &blocks[open.first_block]);
  }
}

void TopologyBuilder::try_split(Open& open, const Bins* bins) const {
  const Binning binning = open.trial.binning;
  Bins all;
  kernels_.clear(all, binning);
  for (uint64_t i = 0; i < open.block_count; ++i) kernels_.merge(bins[i], binning, all);
  open.trial = kernels_.find_split(open.node, all, binning);
  if (!is_better(open.node, open.trial, open.split)) open.trial.axis = -1;
}

void TopologyBuilder::count_sides(const Open& open, const Bins& bins, Block& block,
                                  int from) const {
  if (open.trial.binning.kind == SplitKind::kPlanes) {
    kernels_.count_parts(build_.references[from] + block.begin, block.count, open.node, open.trial,
                         cutting_, block.trial);
    return;
  }
  const uint32_t* count = bins.count[open.trial.axis];
  block.trial[0] = std::accumulate(count, count + open.trial.bin, uint64_t{0});
  block.trial[1] = block.count - block.trial[0];
}

void TopologyBuilder::adopt_trial(Open& open, Block* blocks) {
  uint64_t* placed = open.trial.placed;
  std::fill_n(placed, 2, 0);
  for (uint64_t i = 0; i < open.block_count; ++i) {
    for (int side = 0; side < 2; ++side) placed[side] += blocks[i].trial[side];
  }
  if (placed[0] == 0 || placed[1] == 0) return;  // in the end none was cut
  open.split = open.trial;
  for (uint64_t i = 0; i < open.block_count; ++i) {
    std::copy_n(blocks[i].trial, 2, blocks[i].placed);
  }
}

// The children's references, and where those of each block go.
void TopologyBuilder::place(Open& open, Block* blocks, int to) const {
  place_sides(open.node, open.split.placed, open.child);
  for (int side = 0; side < 2; ++side) {
    SahReference* at = build_.references[to] + open.child[side].begin;
    for (uint64_t i = 0; i < open.block_count; ++i) {
      blocks[i].to[side] = at;
      at += blocks[i].placed[side];
    }
  }
}

void TopologyBuilder::add_subtree(const Open& open, uint32_t depth, int from) {
  if (open.parent != kNone) {
    top_[open.parent].subtree[open.side] = static_cast<uint32_t>(subtrees_.size());
  }
  SahSubtree& subtree = subtrees_.emplace_back(open.node, memory_);
  subtree.depth = depth;
  subtree.at[0] = build_.references[from];
  subtree.at[1] = build_.references[1 - from];
  subtree.primitives = build_.primitives;
  subtree.boxes = build_.boxes;
  subtree.cutting = cutting();
}

void TopologyBuilder::add_children(const Open& open, Level& next) {
  const auto pair = static_cast<uint32_t>(top_.size());
  // Counts are known once all is done.
  TopologyNode& made = open.parent == kNone ? root_ : top_[open.parent].nodes.child[open.side];
  made.box = open.node.extent.box.box();
  made.first = pair;
  made.is_leaf = false;
  top_.emplace_back();
  for (uint32_t side = 0; side < 2; ++side) next.push_back({open.child[side], pair, side});
}

// Lays out a pair of the top from `at` on, and what is below it. Returns the place after.
uint64_t TopologyBuilder::place(uint32_t top, uint64_t at, Array<NodePair>& pairs,
                                std::pmr::vector<uint64_t>& places) const {
  const uint64_t own = at++;
  NodePair pair = top_[top].nodes;
  for (int side = 0; side < 2; ++side) {
    const uint32_t subtree = top_[top].subtree[side];
    if (subtree == kNone) {
      const uint32_t below = pair.child[side].first;
      pair.child[side].first = static_cast<uint32_t>(at);
      at = place(below, at, pairs, places);
      pair.child[side].count = pairs[pair.child[side].first].count();
    } else {
      places[subtree] = at;
      pair.child[side] = subtrees_[subtree].root;
      if (!pair.child[side].is_leaf) pair.child[side].first += static_cast<uint32_t>(at);
      at += subtrees_[subtree].pairs.size();
    }
  }
  pairs[own] = pair;
  return at;
}

Array<NodePair> TopologyBuilder::collect(TopologyNode& root) const {
  uint64_t count = top_.size();
  for (const SahSubtree& subtree : subtrees_) count += subtree.pairs.size();
  Array<NodePair> pairs(count, memory_);
  std::pmr::vector<uint64_t> places(subtrees_.size(), &memory_);
  if (top_.empty()) {
    root = subtrees_[0].root;
  } else {
    place(0, 0, pairs, places);
    root = root_;
    root.count = pairs[0].count();
  }
  scheduler_.for_each(subtrees_.size(), [&](uint64_t i) {
    NodePair* to = pairs.data() + places[i];
    for (const NodePair& pair : subtrees_[i].pairs) {
      NodePair& moved = *to++ = pair;
      for (TopologyNode& node : moved.child) {
        if (!node.is_leaf) node.first += static_cast<uint32_t>(places[i]);
      }
    }
  });
  return pairs;
}

}  // namespace sobb
