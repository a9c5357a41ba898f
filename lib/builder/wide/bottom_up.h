// SPDX-License-Identifier: Apache-2.0
// The walk over a wide hierarchy from its leaves to its root, for whatever a node's value is
// computed from: the k-DOPs and volumes of a build, the volumes of the research comparisons.
//
// A visitor computes the values:
//   Value                                      the value of a leaf or node
//   void prefetch(treelet, at)                 called before the walk comes to node `at`: what the
//                                              nodes before it need may be read ahead
//   void visit_leaf(wide, i, value)            computes the value of the leaf that is child i
//   void visit_node(index, wide, child, value) computes the value of a node, the file's `index`-th,
//                                              from its children's values, *child[i]
// Threads call it at once, for different nodes.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "base/scheduler.h"
#include "builder/wide/wide_topology.h"

namespace sobb {

// Walks a treelet from its last node to its first, so that children come before their parent, and
// returns the value of its root. subtree_value(node, i) points to the value of the subtree that is
// child i of a node of the top, and is null for a child within the treelet.
template <class Visitor, class SubtreeValue>
typename Visitor::Value walk_treelet(const Treelet& treelet, const Visitor& visitor,
                                     std::pmr::memory_resource& memory,
                                     const SubtreeValue& subtree_value) {
  using Value = typename Visitor::Value;
  std::pmr::vector<Value> values(treelet.nodes.size(), &memory);
  for (size_t at = treelet.nodes.size(); at-- > 0;) {
    visitor.prefetch(treelet, at);
    const WideNode& wide = treelet.nodes[at];
    Value leaf[kMaxWidth];
    const Value* child[kMaxWidth] = {};
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (wide.is_leaf(i)) {
        visitor.visit_leaf(wide, i, leaf[i]);
        child[i] = &leaf[i];
      } else {
        const Value* const subtree = subtree_value(static_cast<uint32_t>(at), i);
        child[i] = subtree != nullptr ? subtree : &values[wide.index[i] - treelet.first_node];
      }
    }
    visitor.visit_node(treelet.first_node + at, wide, child, values[at]);
  }
  return std::move(values[0]);
}

// Walks all subtrees in parallel and returns the values of their roots. Before each subtree
// report(fraction) tells how many of them are done.
template <class Visitor, class Report>
std::pmr::vector<typename Visitor::Value> walk_subtrees(const WideTopology& wide,
                                                        const Visitor& visitor,
                                                        const Scheduler& scheduler,
                                                        std::pmr::memory_resource& memory,
                                                        const Report& report) {
  using Value = typename Visitor::Value;
  const size_t count = wide.subtrees.size();
  std::pmr::vector<Value> roots(count, &memory);
  std::atomic<uint64_t> done{0};
  scheduler.for_each(count, [&](uint64_t i) {
    report(static_cast<double>(done) / static_cast<double>(count));
    const auto none = [](uint32_t, uint32_t) -> const Value* { return nullptr; };
    roots[i] = walk_treelet(wide.subtrees[i], visitor, memory, none);
    ++done;
  });
  return roots;
}

// Walks the top, given the values of the subtrees' roots, and returns the value of its root.
template <class Visitor>
typename Visitor::Value walk_top(const WideTopology& wide, const Visitor& visitor,
                                 std::pmr::memory_resource& memory,
                                 const std::pmr::vector<typename Visitor::Value>& roots) {
  using Value = typename Visitor::Value;
  const auto subtree_value = [&](uint32_t node, uint32_t child) -> const Value* {
    const auto at = std::lower_bound(
        wide.places.begin(), wide.places.end(), std::pair(node, child),
        [](const WideTopology::Place& place, const std::pair<uint32_t, uint32_t>& wanted) {
          return std::pair(place.node, place.child) < wanted;
        });
    const bool found = at != wide.places.end() && at->node == node && at->child == child;
    return found ? &roots[static_cast<size_t>(at - wide.places.begin())] : nullptr;
  };
  return walk_treelet(wide.top, visitor, memory, subtree_value);
}

}  // namespace sobb
