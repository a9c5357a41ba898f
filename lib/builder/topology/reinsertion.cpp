// SPDX-License-Identifier: Apache-2.0
// Reinsertion takes a node out of the tree and puts it back where the areas of inner nodes become
// smallest. Here node N goes from beside S to beside T:
//
//   root              root           keeps its box
//   +- A              +- A           shrinks
//   |  +- P           |  +- S        takes the place of its parent P
//   |  |  +- S        |  +- C
//   |  |  +- N   =>   +- B           grows
//   |  +- C              +- P        is made anew in the place of T
//   +- B                 |  +- T
//      +- T              |  +- N
//      +- D              +- D
//
// The pair that held S and N takes T and N. The search for T climbs from N to the root. Beside each
// node on its way, the pivot, hangs a subtree (that of C, then of B). The search looks at it from
// the top down, as long as a place there may gain more than the best so far.
#include "builder/topology/reinsertion.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "format/layout.h"

namespace sobb {
namespace {

// Where a node lies: twice its pair, plus 1 for the right child; or kRoot.
using Place = uint32_t;
constexpr Place kRoot = 0xFFFFFFFF;
constexpr Place kNowhere = 0xFFFFFFFE;

// The node at `from` becomes the sibling of the node at `to`, under a new parent.
struct Reinsertion {
  Place from;
  Place to;
  double gain;  // half the area that inner nodes lose
};

// The search for the best reinsertion of one node.
struct PlaceSearch {
  const Box& box;    // the node's
  double half_area;  // of that box; a new parent has at least as much
  Reinsertion best;
  uint32_t pairs_left;  // that the search may still look at
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
    std::pmr::vector<Reinsertion> moves(places.size(), &memory_);
    scheduler_.for_ranges(places.size(), kGrain, [&](uint64_t begin, uint64_t end) {
      stage.advance(0);
      for (uint64_t i = begin; i < end; ++i) moves[i] = best_reinsertion(places[i]);
    });
    std::erase_if(moves, [](const Reinsertion& move) { return move.to == kNowhere; });
    std::sort(moves.begin(), moves.end(), [](const Reinsertion& a, const Reinsertion& b) {
      return a.gain > b.gain || (a.gain == b.gain && a.from < b.from);
    });
    std::pmr::vector<bool> touched(2 * pairs_.size(), false, &memory_);
    for (const Reinsertion& move : moves) apply(move, touched);
  }

  // Lays the nodes out again, depth first. If the tree has become too deep for a file, leaves it as
  // it was before the first round.
  void finish() const {
    if (depth() <= kMaxDepth) lay_out();
  }

 private:
  static constexpr uint64_t kGrain = 1024;
  // A gain below this share of the root's area is not worth a reinsertion.
  static constexpr double kLeastGain = 1e-7;
  // A search looks at this many pairs at most, so that no scene takes time without bound. (Without
  // the limit the trees of the scenes tried are the same.)
  static constexpr uint32_t kMostPairs = 1 << 14;
  // A sample of about this many nodes tells how large the largest are.
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

  // The places of the nodes with the largest boxes, `share` of all nodes. The root's children are
  // left out: they have no better place.
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

  // Finds where a node gains most. `rest` is the pivot's box without the node. `gain` is the half
  // area that is saved on the way up to the pivot: the parent's own, and what other ancestors lose.
  Reinsertion best_reinsertion(Place from) const {
    PlaceSearch search = {
        at(from).box, at(from).box.half_area(), {from, kNowhere, least_gain_}, kMostPairs};
    Place pivot = parent(from);
    Box rest = at(sibling(from)).box;
    double gain = at(pivot).box.half_area();
    // In a place below the old sibling the node makes the sibling as large as the parent is now. Of
    // the parent's area only the sibling's is saved.
    if (!at(sibling(from)).is_leaf) search_below(at(sibling(from)), rest.half_area(), search);
    while (pivot != kRoot) {
      const Place beside = sibling(pivot);
      const double gain_below = try_place(beside, gain, search);
      if (!at(beside).is_leaf) search_below(at(beside), gain_below, search);
      rest.grow(at(beside).box);
      pivot = parent(pivot);
      gain += at(pivot).box.half_area() - rest.half_area();
    }
    return search.best;
  }

  // Tries the place beside a node, where everything but the new parent gains `gain`. Returns the
  // same for the places below the node, which makes the node grow.
  double try_place(Place place, double gain, PlaceSearch& search) const {
    const Box& box = at(place).box;
    const double both = half_area_of_both(box, search.box);
    if (gain - both > search.best.gain) search.best = {search.best.from, place, gain - both};
    return gain - (both - box.half_area());
  }

  // Tries the places below a node, but for those where the smallest possible parent gains too
  // little.
  void search_below(const TopologyNode& node, double gain, PlaceSearch& search) const {
    struct PendingPair {
      uint32_t pair;
      double gain;
    };
    PendingPair stack[2 * kMaxDepth];
    uint32_t top = 0;
    stack[top++] = {node.first, gain};
    while (top != 0 && search.pairs_left != 0) {
      const PendingPair pending = stack[--top];
      if (pending.gain - search.half_area <= search.best.gain) continue;
      --search.pairs_left;
      for (uint32_t side = 0; side < 2; ++side) {
        const Place place = 2 * pending.pair + side;
        const double gain_below = try_place(place, pending.gain, search);
        if (!at(place).is_leaf && top < 2 * kMaxDepth) stack[top++] = {at(place).first, gain_below};
      }
    }
  }

  // Carries a reinsertion out, unless one before it in the round touched a place that this one
  // changes: those of the node's pair, which the new parent takes over, of the old parent, where
  // the sibling goes, and of the new sibling.
  void apply(const Reinsertion& move, std::pmr::vector<bool>& touched) {
    const Place up = parent(move.from);
    const Place places[] = {move.from, sibling(move.from), up, move.to};
    if (up == kRoot) return;
    if (std::any_of(places, places + 4, [&](Place place) { return touched[place]; })) return;
    for (Place place = move.to; place != kRoot; place = parent(place)) {
      if (place == move.from) return;  // an earlier one put the new sibling below the node
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

  // Recomputes boxes from a node upward, as far as they change.
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

  // Calls visit(pair, its parent's place, its depth) for all pairs, depth first. visit() returns
  // the pair's number in the order that it makes; places of parents count by it.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    struct PendingPair {
      uint32_t pair;
      Place up;
      uint32_t depth;
    };
    std::pmr::vector<PendingPair> stack(&memory_);
    stack.push_back({root_.first, kRoot, 1});
    while (!stack.empty()) {
      const PendingPair pending = stack.back();
      stack.pop_back();
      const uint32_t visited = visit(pending.pair, pending.up, pending.depth);
      for (uint32_t side = 2; side-- > 0;) {
        const TopologyNode& child = pairs_[pending.pair].child[side];
        if (!child.is_leaf) stack.push_back({child.first, 2 * visited + side, pending.depth + 1});
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

  BinaryNodes& nodes_;  // unchanged until finish()
  const Scheduler& scheduler_;
  Memory& memory_;
  TopologyNode root_;
  Array<NodePair> pairs_;
  std::pmr::vector<Place> parent_;  // of each pair
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
