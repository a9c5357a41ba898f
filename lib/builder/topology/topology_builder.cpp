// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/topology_builder.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace sobb {
namespace {

constexpr uint64_t kChunk = 1 << 14;  // references of one task
// A subtree has at most 1/kSubtreeParts of the references, or kSubtreeReferences if that is more:
// enough subtrees to share among threads, each small enough for a cache.
constexpr uint64_t kSubtreeParts = 256;
constexpr uint64_t kSubtreeReferences = 4096;
// The share of the progress that making the top takes, by measured time.
constexpr double kTopShare = 0.4;
// A spatial split is tried only where the sides of the best other split have this share of the
// root's area in common, as in Stich et al.
constexpr double kLeastOverlap = 1e-5;

}  // namespace

void TopologyBuilder::build(Progress& progress, double progress_begin, double progress_end) {
  const double progress_of_top = progress_begin + (progress_end - progress_begin) * kTopShare;
  const uint64_t limit = std::max(kSubtreeReferences, build_.count / kSubtreeParts);
  Level level({{bound_all(), {}}}, &memory_);
  cutting_.least_overlap = level[0].node.extent.box.box().half_area() * kLeastOverlap;
  for (uint32_t depth = 0; !level.empty(); ++depth) {
    // Each level halves the nodes: ten levels do nearly all of the work.
    progress.check(progress_begin, progress_of_top, std::min(1.0, depth / 10.0));
    const int from = static_cast<int>(depth % 2);
    Level large(&memory_);
    for (const TopNode& top : level) {
      if (top.node.count <= limit || depth >= kDeepestSplit) {
        add_subtree(top, depth, from);
      } else {
        large.push_back(top);
      }
    }
    split_level(large, from);
    level.clear();
    for (const TopNode& top : large) {
      if (top.split.axis < 0) {
        add_subtree(top, depth, from);
      } else {
        add_children(top, level);
      }
    }
  }
  std::atomic<uint64_t> done{0};
  const std::span<SahSubtree> subtrees = top_.subtrees();
  scheduler_.for_each(subtrees.size(), [&](uint64_t i) {
    progress.check(progress_of_top, progress_end,
                   static_cast<double>(done) / static_cast<double>(subtrees.size()));
    kernels_.build(subtrees[i]);
    ++done;
  });
}

SahNode TopologyBuilder::bound_all() const {
  std::pmr::vector<SahExtent> parts((build_.count + kChunk - 1) / kChunk, &memory_);
  scheduler_.for_ranges(build_.count, kChunk, [&](uint64_t begin, uint64_t end) {
    SahExtent& part = parts[begin / kChunk];
    part = SahExtent::nothing();
    kernels_.bound(build_.references[0] + begin, end - begin, part);
  });
  SahNode node = {parts[0], 0, build_.count, build_.room};
  for (const SahExtent& part : parts) node.extent.grow(part);
  return node;
}

// Looks for the best split of every node of a level, and moves the references of nodes that have
// one to the other array, sorted by side.
void TopologyBuilder::split_level(Level& level, int from) const {
  Chunks chunks(&memory_);
  for (TopNode& top : level) {
    top.first_chunk = chunks.size();
    top.chunk_count = (top.node.count + kChunk - 1) / kChunk;
    for (uint64_t i = 0; i < top.chunk_count; ++i) {
      chunks.push_back({static_cast<uint32_t>(&top - level.data()), top.node.begin + i * kChunk,
                        std::min(kChunk, top.node.count - i * kChunk)});
    }
  }
  for (const SplitKind kind : kSplitKinds) try_splits(kind, level, chunks, from);
  for (TopNode& top : level) {
    if (top.split.axis >= 0) place_references(top, &chunks[top.first_chunk], 1 - from);
  }
  scheduler_.for_each(chunks.size(), [&](uint64_t i) {
    ReferenceChunk& chunk = chunks[i];
    const TopNode& top = level[chunk.node];
    if (top.split.axis < 0) return;
    kernels_.partition(build_.references[from] + chunk.begin, chunk.count, top.node, top.split,
                       cutting(), chunk.to[0], chunk.to[1], chunk.extent);
  });
  for (TopNode& top : level) {
    for (int side = 0; side < 2; ++side) {
      for (uint64_t i = 0; i < top.chunk_count; ++i) {
        top.child[side].extent.grow(chunks[top.first_chunk + i].extent[side]);
      }
    }
  }
}

// Looks for a split of one kind that is better than each node's best so far.
void TopologyBuilder::try_splits(SplitKind kind, Level& level, Chunks& chunks, int from) const {
  bool any = false;
  for (TopNode& top : level) {
    top.trial = {};
    top.trial.binning = make_binning(kind, top.node, top.split, cutting());
    any |= top.trial.binning.count > 0;
  }
  if (!any) return;
  Array<Bins> bins(chunks.size(), memory_);
  scheduler_.for_each(chunks.size(), [&](uint64_t i) {
    const Binning& binning = level[chunks[i].node].trial.binning;
    if (binning.count == 0) return;
    kernels_.clear(bins[i], binning);
    kernels_.bin(build_.references[from] + chunks[i].begin, chunks[i].count, binning, cutting(),
                 bins[i]);
  });
  scheduler_.for_each(level.size(), [&](uint64_t i) {
    if (level[i].trial.binning.count > 0) try_split(level[i], &bins[level[i].first_chunk]);
  });
  scheduler_.for_each(chunks.size(), [&](uint64_t i) {
    const TopNode& top = level[chunks[i].node];
    if (top.trial.axis >= 0) count_sides(top, bins[i], chunks[i], from);
  });
  for (TopNode& top : level) {
    if (top.trial.axis >= 0) adopt_trial(top, &chunks[top.first_chunk]);
  }
}

void TopologyBuilder::try_split(TopNode& top, const Bins* bins) const {
  const Binning binning = top.trial.binning;
  Bins all;
  kernels_.clear(all, binning);
  for (uint64_t i = 0; i < top.chunk_count; ++i) kernels_.merge(bins[i], binning, all);
  top.trial = kernels_.find_split(top.node, all, binning);
  if (!is_better(top.node, top.trial, top.split)) top.trial.axis = -1;
}

void TopologyBuilder::count_sides(const TopNode& top, const Bins& bins, ReferenceChunk& chunk,
                                  int from) const {
  if (top.trial.binning.kind == SplitKind::kPlanes) {
    kernels_.count_parts(build_.references[from] + chunk.begin, chunk.count, top.node, top.trial,
                         cutting_, chunk.trial);
    return;
  }
  const uint32_t* count = bins.count[top.trial.axis];
  chunk.trial[0] = std::accumulate(count, count + top.trial.bin, uint64_t{0});
  chunk.trial[1] = chunk.count - chunk.trial[0];
}

void TopologyBuilder::adopt_trial(TopNode& top, ReferenceChunk* chunks) {
  uint64_t* placed = top.trial.placed;
  std::fill_n(placed, 2, 0);
  for (uint64_t i = 0; i < top.chunk_count; ++i) {
    for (int side = 0; side < 2; ++side) placed[side] += chunks[i].trial[side];
  }
  if (placed[0] == 0 || placed[1] == 0) return;  // no reference is on that side after all
  top.split = top.trial;
  for (uint64_t i = 0; i < top.chunk_count; ++i) {
    std::copy_n(chunks[i].trial, 2, chunks[i].placed);
  }
}

// Places the children's references, and says where those of each chunk go.
void TopologyBuilder::place_references(TopNode& top, ReferenceChunk* chunks, int to) const {
  place_sides(top.node, top.split.placed, top.child);
  for (int side = 0; side < 2; ++side) {
    SahReference* at = build_.references[to] + top.child[side].begin;
    for (uint64_t i = 0; i < top.chunk_count; ++i) {
      chunks[i].to[side] = at;
      at += chunks[i].placed[side];
    }
  }
}

void TopologyBuilder::add_subtree(const TopNode& top, uint32_t depth, int from) {
  SahSubtree& subtree = top_.add_subtree(top.place, top.node);
  subtree.depth = depth;
  subtree.at[0] = build_.references[from];
  subtree.at[1] = build_.references[1 - from];
  subtree.primitives = build_.primitives;
  subtree.cuts = build_.cuts;
  subtree.cutting = cutting();
}

void TopologyBuilder::add_children(const TopNode& top, Level& next) {
  const uint32_t pair = top_.add_pair(top.place, top.node.extent.box.box());
  for (uint32_t side = 0; side < 2; ++side) next.push_back({top.child[side], {pair, side}});
}

}  // namespace sobb
