// SPDX-License-Identifier: Apache-2.0
#include "build/topology_builder.h"

#include <algorithm>
#include <atomic>

namespace sobb {
namespace {

constexpr uint64_t kBlock = 1 << 14;  // references
// A subtree has at most this part of the references, or this many: enough subtrees to share among
// threads, each small enough for a cache.
constexpr uint64_t kSubtreeParts = 256;
constexpr uint64_t kSubtreeReferences = 4096;
// The part of the progress in which the top is made, by measured time.
constexpr double kTopShare = 0.4;

void add(const Centres& centres, Centres& to) {
  for (int k = 0; k < 3; ++k) {
    to.lower[k] = std::min(to.lower[k], centres.lower[k]);
    to.upper[k] = std::max(to.upper[k], centres.upper[k]);
  }
}

}  // namespace

void TopologyBuilder::build(Progress& progress, double progress_end) {
  const uint64_t limit = std::max(kSubtreeReferences, count_ / kSubtreeParts);
  std::pmr::vector<Open> level({{bound_all(), kNone, 0}}, &memory_);
  for (uint32_t depth = 0; !level.empty(); ++depth) {
    // A root's children are half as large, and so on: so many levels are nearly all.
    progress.check(0, progress_end * kTopShare, std::min(1.0, depth / 10.0));
    const int from = static_cast<int>(depth % 2);
    std::pmr::vector<Open> large(&memory_);
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
    progress.check(progress_end * kTopShare, progress_end,
                   static_cast<double>(done) / static_cast<double>(subtrees_.size()));
    kernels_.build(subtrees_[i]);
    ++done;
  });
}

SahNode TopologyBuilder::bound_all() const {
  std::pmr::vector<SahNode> parts((count_ + kBlock - 1) / kBlock, &memory_);
  scheduler_.for_ranges(count_, kBlock, [&](uint64_t begin, uint64_t end) {
    SahNode& part = parts[begin / kBlock];
    part = {FlatBox::nothing(), Centres::nothing(), begin, end - begin};
    kernels_.bound(at_[0] + begin, end - begin, part.box, part.centres);
  });
  SahNode node = parts[0];
  node.count = count_;
  for (const SahNode& part : parts) {
    for (int k = 0; k < 8; ++k) node.box.at[k] = std::min(node.box.at[k], part.box.at[k]);
    add(part.centres, node.centres);
  }
  return node;
}

// Moves the references of all nodes of a level to the other array, for those that have a split.
void TopologyBuilder::split_level(std::pmr::vector<Open>& level, int from) const {
  std::pmr::vector<Block> blocks(&memory_);
  for (Open& open : level) {
    open.binning = make_binning(open.node.centres, open.node.count);
    open.first_block = blocks.size();
    open.block_count = (open.node.count + kBlock - 1) / kBlock;
    for (uint64_t i = 0; i < open.block_count; ++i) {
      blocks.push_back({static_cast<uint32_t>(&open - level.data()), open.node.begin + i * kBlock,
                        std::min(kBlock, open.node.count - i * kBlock)});
    }
  }
  Array<Bins> bins(blocks.size(), memory_);
  scheduler_.for_each(blocks.size(), [&](uint64_t i) {
    const Binning& binning = level[blocks[i].open].binning;
    kernels_.clear(bins[i], binning.count);
    kernels_.bin(at_[from] + blocks[i].begin, blocks[i].count, binning, bins[i]);
  });
  scheduler_.for_each(level.size(), [&](uint64_t i) {
    Open& open = level[i];
    find_split(open, bins.data() + open.first_block, &blocks[open.first_block], 1 - from);
  });
  scheduler_.for_each(blocks.size(), [&](uint64_t i) {
    Block& block = blocks[i];
    const Open& open = level[block.open];
    if (open.split.axis < 0) return;
    kernels_.partition(at_[from] + block.begin, block.count, open.binning, open.split, block.left,
                       block.right, block.centres);
  });
  // The centres of a node's first block become those of all.
  for (const Open& open : level) {
    Block* of = &blocks[open.first_block];
    for (int side = 0; side < 2; ++side) {
      for (uint64_t i = 1; i < open.block_count; ++i) add(of[i].centres[side], of->centres[side]);
    }
  }
  for (Open& open : level) {
    std::copy_n(blocks[open.first_block].centres, 2, open.centres);
  }
}

void TopologyBuilder::find_split(Open& open, const Bins* bins, Block* blocks, int to) const {
  Bins all;
  kernels_.clear(all, open.binning.count);
  for (uint64_t i = 0; i < open.block_count; ++i) kernels_.merge(bins[i], open.binning.count, all);
  open.split = kernels_.find_split(open.node, all, open.binning.count);
  if (open.split.axis < 0) return;
  SahReference* left = at_[to] + open.node.begin;
  SahReference* right = left + open.split.left_count;
  for (uint64_t i = 0; i < open.block_count; ++i) {
    blocks[i].left = left;
    blocks[i].right = right;
    uint64_t left_count = 0;
    for (uint32_t bin = 0; bin < open.split.bin; ++bin) {
      left_count += bins[i].count[open.split.axis][bin];
    }
    left += left_count;
    right += blocks[i].count - left_count;
  }
}

void TopologyBuilder::add_subtree(const Open& open, uint32_t depth, int from) {
  if (open.parent != kNone) {
    top_[open.parent].subtree[open.side] = static_cast<uint32_t>(subtrees_.size());
  }
  SahSubtree& subtree = subtrees_.emplace_back(open.node, memory_);
  subtree.depth = depth;
  subtree.at[0] = at_[from];
  subtree.at[1] = at_[1 - from];
  subtree.primitives = primitives_;
}

void TopologyBuilder::add_children(const Open& open, std::pmr::vector<Open>& next) {
  const auto pair = static_cast<uint32_t>(top_.size());
  // Counts are known once all is done.
  TopologyNode& made = open.parent == kNone ? root_ : top_[open.parent].nodes.child[open.side];
  made.box = open.node.box.box();
  made.first = pair;
  made.is_leaf = false;
  top_.emplace_back();
  uint64_t begin = open.node.begin;
  for (uint32_t side = 0; side < 2; ++side) {
    const uint64_t count =
        side == 0 ? open.split.left_count : open.node.count - open.split.left_count;
    next.push_back({{open.split.box[side], open.centres[side], begin, count}, pair, side});
    begin += count;
  }
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
