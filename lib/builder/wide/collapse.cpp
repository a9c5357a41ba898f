// SPDX-License-Identifier: Apache-2.0
#include "builder/wide/collapse.h"

#include <algorithm>

#include "base/error.h"
#include "builder/wide/least_cost_cut.h"
#include "format/layout.h"

namespace sobb {
namespace {

// A subtree has at most 1/kSubtreeParts of the references, or kSubtreeReferences if that is more:
// enough subtrees to share among threads, each large enough to be worth a task.
constexpr uint64_t kSubtreeParts = 256;
constexpr uint64_t kSubtreeReferences = 4096;

// Chooses the children of the wide node that stands for a binary one, by rising area per triangle.
// A traversal that looks for any hit pushes them in this order and pops the last one first: the
// likeliest occluder. Few triangles in a large box are large ones (walls, floors), and soon tested.
uint32_t choose_children(const LeastCostCut& cut, const TopologyNode& node,
                         const TopologyNode* child[kMaxWidth]) {
  const uint32_t count = cut.children(node, child);
  double area_each[kMaxWidth];
  for (uint32_t i = 0; i < count; ++i) {  // insertion sort, stable
    const TopologyNode* const one = child[i];
    const double area = one->box.half_area() / one->count;
    uint32_t at = i;
    for (; at != 0 && area_each[at - 1] > area; --at) {
      area_each[at] = area_each[at - 1];
      child[at] = child[at - 1];
    }
    area_each[at] = area;
    child[at] = one;
  }
  return count;
}

// Adds a leaf to a node's children, and its blocks to the treelet.
void add_leaf(const TopologyNode& leaf, WideNode& node, Treelet& treelet) {
  const uint32_t i = node.child_count++;
  node.index[i] = static_cast<uint32_t>(treelet.block_count);
  node.first[i] = leaf.first;
  node.count[i] = static_cast<uint8_t>(leaf.count);
  treelet.block_count += blocks_of(leaf.count);
  treelet.reference_count += leaf.count;
}

// Collapses the subtree of a binary node, depth first, siblings next to each other.
void collapse_subtree(const LeastCostCut& cut, const TopologyNode& root, Treelet& treelet) {
  struct PendingNode {
    const TopologyNode* node;
    uint32_t index;  // of the wide node
    uint32_t depth;
  };
  std::pmr::vector<PendingNode> stack(treelet.nodes.get_allocator());
  stack.push_back({&root, 0, 1});
  treelet.nodes.resize(1);
  while (!stack.empty()) {
    const PendingNode pending = stack.back();
    stack.pop_back();
    treelet.depth = std::max(treelet.depth, pending.depth);
    WideNode wide{};
    const TopologyNode* child[kMaxWidth];
    const uint32_t count = choose_children(cut, *pending.node, child);
    for (uint32_t i = 0; i < count; ++i) {
      if (child[i]->is_leaf) {
        add_leaf(*child[i], wide, treelet);
      } else {
        wide.index[wide.child_count++] = static_cast<uint32_t>(treelet.nodes.size());
        treelet.nodes.emplace_back();
      }
    }
    for (uint32_t i = count; i-- > 0;) {
      if (!child[i]->is_leaf) stack.push_back({child[i], wide.index[i], pending.depth + 1});
    }
    treelet.nodes[pending.index] = wide;
  }
}

// The roots of the subtrees, and how many wide nodes lie above each.
struct SubtreeRoots {
  std::pmr::vector<const TopologyNode*> nodes;
  std::pmr::vector<uint32_t> depths;
};

// Collapses the top, breadth first, down to children small enough to be subtrees.
void collapse_top(const LeastCostCut& cut, const TopologyNode& root, uint64_t limit,
                  WideTopology& wide, SubtreeRoots& roots) {
  std::pmr::vector<const TopologyNode*> queue({&root}, wide.top.nodes.get_allocator());
  std::pmr::vector<uint32_t> depth({1U}, wide.top.nodes.get_allocator());
  for (size_t next = 0; next < queue.size(); ++next) {
    WideNode node{};
    const TopologyNode* children[kMaxWidth];
    const uint32_t count = choose_children(cut, *queue[next], children);
    wide.top.depth = std::max(wide.top.depth, depth[next]);
    for (uint32_t i = 0; i < count; ++i) {
      const TopologyNode* child = children[i];
      if (child->is_leaf) {
        add_leaf(*child, node, wide.top);
        continue;
      }
      ++node.child_count;
      if (child->count > limit) {
        node.index[i] = static_cast<uint32_t>(queue.size());
        queue.push_back(child);
        depth.push_back(depth[next] + 1);
      } else {
        // collapse() fills in its index, once the subtrees before it are made.
        wide.places.push_back({static_cast<uint32_t>(next), i});
        roots.nodes.push_back(child);
        roots.depths.push_back(depth[next]);
      }
    }
    wide.top.nodes.push_back(node);
  }
}

// Turns a treelet's own indices into the file's.
void relocate(Treelet& treelet) {
  for (WideNode& node : treelet.nodes) {
    for (uint32_t i = 0; i < node.child_count; ++i) {
      node.index[i] +=
          static_cast<uint32_t>(node.is_leaf(i) ? treelet.first_block : treelet.first_node);
    }
  }
}

}  // namespace

WideTopology collapse(const Topology& topology, uint32_t width, const Scheduler& scheduler,
                      std::pmr::memory_resource& memory) {
  WideTopology wide(topology.references(), memory);
  SubtreeRoots roots{std::pmr::vector<const TopologyNode*>(&memory),
                     std::pmr::vector<uint32_t>(&memory)};
  const uint64_t limit =
      std::max<uint64_t>(kSubtreeReferences, topology.root().count / kSubtreeParts);
  const LeastCostCut cut(topology, width, limit, scheduler, memory);
  collapse_top(cut, topology.root(), limit, wide, roots);
  for (size_t i = 0; i < wide.places.size(); ++i) wide.subtrees.emplace_back(memory);
  scheduler.for_each(wide.subtrees.size(),
                     [&](uint64_t i) { collapse_subtree(cut, *roots.nodes[i], wide.subtrees[i]); });

  wide.depth = wide.top.depth;
  wide.node_count = wide.top.nodes.size();
  wide.block_count = wide.top.block_count;
  wide.reference_count = wide.top.reference_count;
  for (size_t i = 0; i < wide.subtrees.size(); ++i) {
    Treelet& treelet = wide.subtrees[i];
    treelet.first_node = wide.node_count;
    treelet.first_block = wide.block_count;
    wide.node_count += treelet.nodes.size();
    wide.block_count += treelet.block_count;
    wide.reference_count += treelet.reference_count;
    wide.depth = std::max(wide.depth, roots.depths[i] + treelet.depth);
    const auto [node, child] = wide.places[i];
    wide.top.nodes[node].index[child] = static_cast<uint32_t>(treelet.first_node);
  }
  if (wide.depth > kMaxDepth) {
    fail(SOBB_ERROR_INTERNAL, "the topology is %u nodes deep, more than %u", wide.depth, kMaxDepth);
  }
  scheduler.for_each(wide.subtrees.size(), [&](uint64_t i) { relocate(wide.subtrees[i]); });
  return wide;
}

}  // namespace sobb
