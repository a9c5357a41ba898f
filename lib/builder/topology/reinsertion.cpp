// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/reinsertion.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "format/layout.h"

namespace sobb {
namespace {

// Where a node is: twice its pair, and which child; or the root.
using Place = uint32_t;
constexpr Place kRoot = 0xFFFFFFFF;
constexpr Place kNowhere = 0xFFFFFFFE;

// A node becomes the sibling of another, under a new parent.
struct Move {
  Place from;
  Place to;
  double gain;  // half the area that inner nodes lose
};

// For the best one of a node.
struct Search {
  const Box& box;  // the node's
  double own;      // half its area: the least that a new parent has
  Move best;
  uint32_t pairs_left;  // to be looked at
};

double half_area_of_both(const Box& a, const Box& b) {
  Box both = a;
  both.grow(b);
  return both.half_area();
}

class Reinserter {
 public:
  Reinserter(BinaryNodes& nodes, const Scheduler& scheduler, Memory& memory)
      : nodes_(nodes),
        scheduler_(scheduler),
        memory_(memory),
        root_(nodes.root),
        pairs_(nodes.pairs.size(), memory),
        parent_(nodes.pairs.size(), &memory),
        least_gain_(kLeastGain * nodes.root.box.half_area()) {
    link(kRoot);
    scheduler.for_ranges(pairs_.size(), kGrain, [&](uint64_t begin, uint64_t end) {
      for (uint64_t i = begin; i < end; ++i) {
        pairs_[i] = nodes.pairs[i];
        for (uint32_t side = 0; side < 2; ++side) link(static_cast<Place>(2 * i + side));
      }
    });
  }

  void round(double share, ProgressStage& stage) {
    const std::pmr::vector<Place> places = largest(share);
    std::pmr::vector<Move> moves(places.size(), &memory_);
    scheduler_.for_ranges(places.size(), kGrain, [&](uint64_t begin, uint64_t end) {
      stage.advance(0);
      for (uint64_t i = begin; i < end; ++i) moves[i] = best_move(places[i]);
    });
    std::erase_if(moves, [](const Move& move) { return move.to == kNowhere; });
    std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
      return a.gain > b.gain || (a.gain == b.gain && a.from < b.from);
    });
    std::pmr::vector<bool> touched(2 * pairs_.size(), false, &memory_);
    for (const Move& move : moves) make(move, touched);
  }

  // Lays the nodes out again; not if they have become too deep for a file.
  void finish() const {
    if (depth() <= kMaxDepth) lay_out();
  }

 private:
  static constexpr uint64_t kGrain = 1024;
  // Smaller moves, by the root's area, are not worth a look.
  static constexpr double kLeastGain = 1e-7;
  // A node looks at so many at most, so that no scene takes time without bound. (Of the scenes
  // tried the trees are the same without.)
  static constexpr uint32_t kMostPairs = 1 << 14;
  // About as many nodes at most tell how large the largest are.
  static constexpr size_t kSample = 1 << 14;

  const TopologyNode& at(Place place) const {
    return place == kRoot ? root_ : pairs_[place / 2].child[place % 2];
  }
  TopologyNode& at(Place place) {
    return place == kRoot ? root_ : pairs_[place / 2].child[place % 2];
  }
  Place parent(Place place) const { return parent_[place / 2]; }
  static Place sibling(Place place) { return place ^ 1; }
  void link(Place place) {
    if (!at(place).is_leaf) parent_[at(place).first] = place;
  }

  // But for the root's children, which have no better place.
  std::pmr::vector<Place> largest(double share) const {
    const size_t count = 2 * pairs_.size();
    std::pmr::vector<double> sample(&memory_);
    for (size_t i = 0; i < count; i += 1 + count / kSample) sample.push_back(half_area(i));
    const auto rank = static_cast<size_t>(share * static_cast<double>(sample.size()));
    const auto nth = sample.begin() + static_cast<ptrdiff_t>(std::min(rank, sample.size() - 1));
    std::nth_element(sample.begin(), nth, sample.end(), std::greater<>());
    const double least = *nth;
    std::pmr::vector<Place> places(&memory_);
    for (size_t i = 0; i < count; ++i) {
      const auto place = static_cast<Place>(i);
      if (half_area(i) >= least && parent(place) != kRoot) places.push_back(place);
    }
    return places;
  }
  double half_area(size_t place) const { return at(static_cast<Place>(place)).box.half_area(); }

  // Where a node gains most. Without it its parent goes, and its ancestors shrink up to the one
  // that it comes to lie under again; there, those between grow, and it has a new parent.
  Move best_move(Place from) const {
    Search search = {
        at(from).box, at(from).box.half_area(), {from, kNowhere, least_gain_}, kMostPairs};
    Place pivot = parent(from);
    Box rest = at(sibling(from)).box;  // what the pivot keeps
    double gain = at(pivot).box.half_area();
    // Its sibling, with the node below it again, would be as large as the parent is.
    if (!at(sibling(from)).is_leaf) look_below(at(sibling(from)), rest.half_area(), search);
    while (pivot != kRoot) {
      const Place beside = sibling(pivot);
      const double below = offer(beside, gain, search);
      if (!at(beside).is_leaf) look_below(at(beside), below, search);
      rest.grow(at(beside).box);
      pivot = parent(pivot);
      gain += at(pivot).box.half_area() - rest.half_area();
    }
    return search.best;
  }

  // As the sibling of a node. `gain` is what is gained above the new parent; returns it for one
  // below the node, which then grows.
  double offer(Place place, double gain, Search& search) const {
    const Box& box = at(place).box;
    const double both = half_area_of_both(box, search.box);
    if (gain - both > search.best.gain) search.best = {search.best.from, place, gain - both};
    return gain - (both - box.half_area());
  }

  // As the sibling of one below a node, wherever the new parent may be small enough.
  void look_below(const TopologyNode& node, double gain, Search& search) const {
    struct Open {
      uint32_t pair;
      double gain;
    };
    Open stack[2 * kMaxDepth];
    uint32_t top = 0;
    stack[top++] = {node.first, gain};
    while (top != 0 && search.pairs_left != 0) {
      const Open open = stack[--top];
      if (open.gain - search.own <= search.best.gain) continue;
      --search.pairs_left;
      for (uint32_t side = 0; side < 2; ++side) {
        const Place place = 2 * open.pair + side;
        const double below = offer(place, open.gain, search);
        if (!at(place).is_leaf && top < 2 * kMaxDepth) stack[top++] = {at(place).first, below};
      }
    }
  }

  // Makes a move if none before it in the round touched what it does: the node's pair, which its
  // new parent takes over; its old parent, where its sibling goes; and its new sibling.
  void make(const Move& move, std::pmr::vector<bool>& touched) {
    const Place up = parent(move.from);
    const Place places[] = {move.from, sibling(move.from), up, move.to};
    if (up == kRoot) return;
    if (std::any_of(places, places + 4, [&](Place place) { return touched[place]; })) return;
    for (Place place = move.to; place != kRoot; place = parent(place)) {
      if (place == move.from) return;  // which came to lie above it
    }
    for (const Place place : places) touched[place] = true;

    const uint32_t pair = move.from / 2;
    const TopologyNode moved = at(move.from);
    at(up) = at(sibling(move.from));
    link(up);
    pairs_[pair].child[0] = at(move.to);
    pairs_[pair].child[1] = moved;
    link(2 * pair);
    link(2 * pair + 1);
    at(move.to).is_leaf = false;
    at(move.to).first = pair;
    link(move.to);
    refit(parent(up));
    refit(move.to);
  }

  // From a node up.
  void refit(Place place) {
    for (;; place = parent(place)) {
      TopologyNode& node = at(place);
      Box box = pairs_[node.first].child[0].box;
      box.grow(pairs_[node.first].child[1].box);
      if (box == node.box) return;
      node.box = box;
      if (place == kRoot) return;
    }
  }

  // Calls visit(pair, its parent's place, the pair's depth) for all pairs, depth first.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    struct Open {
      uint32_t pair;
      uint32_t up;  // the parent's place once visited
      uint32_t depth;
    };
    std::pmr::vector<Open> stack(&memory_);
    stack.push_back({root_.first, kRoot, 1});
    while (!stack.empty()) {
      const Open open = stack.back();
      stack.pop_back();
      const uint32_t visited = visit(open.pair, open.up, open.depth);
      for (uint32_t side = 2; side-- > 0;) {
        const TopologyNode& child = pairs_[open.pair].child[side];
        if (!child.is_leaf) stack.push_back({child.first, 2 * visited + side, open.depth + 1});
      }
    }
  }

  uint32_t depth() const {
    uint32_t deepest = 0;
    for_each_pair([&](uint32_t pair, uint32_t, uint32_t depth) {
      deepest = std::max(deepest, depth);
      return pair;
    });
    return deepest;
  }

  void lay_out() const {
    Array<NodePair>& to = nodes_.pairs;
    uint32_t next = 0;
    nodes_.root = root_;
    nodes_.root.first = 0;
    for_each_pair([&](uint32_t pair, Place up, uint32_t) {
      to[next] = pairs_[pair];
      if (up != kRoot) to[up / 2].child[up % 2].first = next;
      return next++;
    });
    for (uint32_t i = next; i-- > 0;) {
      for (TopologyNode& child : to[i].child) {
        if (!child.is_leaf) child.count = to[child.first].count();
      }
    }
    nodes_.root.count = to[0].count();
  }

  BinaryNodes& nodes_;  // as they were, until the end
  const Scheduler& scheduler_;
  Memory& memory_;
  TopologyNode root_;
  Array<NodePair> pairs_;
  std::pmr::vector<Place> parent_;  // by pair
  double least_gain_;
};

}  // namespace

void reinsert(BinaryNodes& nodes, const ReinsertionEffort& effort, const Scheduler& scheduler,
              Memory& memory, ProgressStage& stage) {
  if (nodes.root.is_leaf || nodes.pairs.size() >= kNowhere / 2) return;
  Reinserter reinserter(nodes, scheduler, memory);
  for (uint32_t i = 0; i < effort.rounds; ++i) {
    reinserter.round(effort.share, stage);
    stage.advance(1);
  }
  reinserter.finish();
}

}  // namespace sobb
