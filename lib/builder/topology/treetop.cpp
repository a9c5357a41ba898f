// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/treetop.h"

namespace sobb {

uint32_t Treetop::add_pair(Place place, const Box& box) {
  const auto pair = static_cast<uint32_t>(pairs_.size());
  // place_pair() fills in the count, once the subtrees are made.
  TopologyNode& made =
      place.pair == Place::kRoot ? root_ : pairs_[place.pair].nodes.child[place.side];
  made.box = box;
  made.first = pair;
  made.is_leaf = false;
  pairs_.emplace_back();
  return pair;
}

SahSubtree& Treetop::add_subtree(Place place, const SahNode& node) {
  if (place.pair != Place::kRoot) {
    pairs_[place.pair].subtree[place.side] = static_cast<uint32_t>(subtrees_.size());
  }
  return subtrees_.emplace_back(node, memory_);
}

Box Treetop::box_below(uint32_t pair) const {
  Box boxes[2];
  for (int side = 0; side < 2; ++side) {
    const uint32_t subtree = pairs_[pair].subtree[side];
    boxes[side] =
        subtree == kNone ? pairs_[pair].nodes.child[side].box : subtrees_[subtree].root.box;
  }
  boxes[0].grow(boxes[1]);
  return boxes[0];
}

void Treetop::bound() {
  for (size_t i = pairs_.size(); i-- > 0;) {
    for (int side = 0; side < 2; ++side) {
      TopologyNode& node = pairs_[i].nodes.child[side];
      if (pairs_[i].subtree[side] == kNone) node.box = box_below(node.first);
    }
  }
  if (!pairs_.empty()) root_.box = box_below(0);
}

// Lays out a pair of the top and all that is below it from `at` on. Returns the place after them.
uint64_t Treetop::place_pair(uint32_t top_pair, uint64_t at, Array<NodePair>& pairs,
                             std::pmr::vector<uint64_t>& places) const {
  const uint64_t own = at++;
  NodePair pair = pairs_[top_pair].nodes;
  for (int side = 0; side < 2; ++side) {
    const uint32_t subtree = pairs_[top_pair].subtree[side];
    if (subtree == kNone) {
      const uint32_t below = pair.child[side].first;
      pair.child[side].first = static_cast<uint32_t>(at);
      at = place_pair(below, at, pairs, places);
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

Array<NodePair> Treetop::collect(const Scheduler& scheduler, TopologyNode& root) const {
  uint64_t count = pairs_.size();
  for (const SahSubtree& subtree : subtrees_) count += subtree.pairs.size();
  Array<NodePair> pairs(count, memory_);
  std::pmr::vector<uint64_t> places(subtrees_.size(), &memory_);
  if (pairs_.empty()) {
    root = subtrees_[0].root;
  } else {
    place_pair(0, 0, pairs, places);
    root = root_;
    root.count = pairs[0].count();
  }
  scheduler.for_each(subtrees_.size(), [&](uint64_t i) {
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
