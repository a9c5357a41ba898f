// SPDX-License-Identifier: Apache-2.0
#include "builder/wide/collapse.h"

#include <algorithm>

#include "base/error.h"
#include "builder/wide/least_cost_cut.h"
#include "format/layout.h"

namespace sobb {
namespace {

// A subtree has at most this part of the references, or this many: enough subtrees to share among
// threads, each large enough to be worth a task.
constexpr uint64_t kSubtreeParts = 256;
constexpr uint64_t kSubtreeReferences = 4096;

// The children of the wide node that stands for a binary one, the likeliest to hide a light last,
// whom a stack gives back first: the one with the most area for each of its triangles. Few
// triangles in a large box are large ones (walls, floors) and soon tested.
uint32_t choose_children(const LeastCostCut& cut, const TopologyNode& node,
                         const TopologyNode* child[kMaxWidth]) {
  const uint32_t count = cut.children(node, child);
  double area_each[kMaxWidth];
  for (uint32_t i = 0; i < count; ++i) {  // stable
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

// Makes a leaf a node's child and takes its blocks.
void add_leaf(const TopologyNode& leaf, WideNode& node, Part& part) {
  const uint32_t i = node.child_count++;
  node.index[i] = static_cast<uint32_t>(part.block_count);
  node.first[i] = leaf.first;
  node.count[i] = static_cast<uint8_t>(leaf.count);
  part.block_count += blocks_of(leaf.count);
  part.reference_count += leaf.count;
}

// Collapses what lies below a binary node, depth first, siblings next to each other.
void collapse_subtree(const LeastCostCut& cut, const TopologyNode& root, Part& part) {
  struct Open {
    const TopologyNode* node;
    uint32_t index;
    uint32_t depth;
  };
  std::pmr::vector<Open> stack(part.nodes.get_allocator());
  stack.push_back({&root, 0, 1});
  part.nodes.resize(1);
  while (!stack.empty()) {
    const Open open = stack.back();
    stack.pop_back();
    part.depth = std::max(part.depth, open.depth);
    WideNode wide{};
    const TopologyNode* child[kMaxWidth];
    const uint32_t count = choose_children(cut, *open.node, child);
    for (uint32_t i = 0; i < count; ++i) {
      if (child[i]->is_leaf) {
        add_leaf(*child[i], wide, part);
      } else {
        wide.index[wide.child_count++] = static_cast<uint32_t>(part.nodes.size());
        part.nodes.emplace_back();
      }
    }
    for (uint32_t i = count; i-- > 0;) {
      if (!child[i]->is_leaf) stack.push_back({child[i], wide.index[i], open.depth + 1});
    }
    part.nodes[open.index] = wide;
  }
}

// Roots of subtrees, and how many wide nodes lie above each.
struct Roots {
  std::pmr::vector<const TopologyNode*> nodes;
  std::pmr::vector<uint32_t> depths;
};

// Collapses the top, breadth first, down to children small enough to be subtrees.
void collapse_top(const LeastCostCut& cut, const TopologyNode& root, uint64_t limit,
                  WideTopology& wide, Roots& roots) {
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
        // Its index is known once the subtrees before it are.
        wide.places.push_back({static_cast<uint32_t>(next), i});
        roots.nodes.push_back(child);
        roots.depths.push_back(depth[next]);
      }
    }
    wide.top.nodes.push_back(node);
  }
}

// Turns a part's own indices into the file's.
void relocate(Part& part) {
  for (WideNode& node : part.nodes) {
    for (uint32_t i = 0; i < node.child_count; ++i) {
      node.index[i] += static_cast<uint32_t>(node.is_leaf(i) ? part.first_block : part.first_node);
    }
  }
}

}  // namespace

WideTopology collapse(const Topology& topology, uint32_t width, const Scheduler& scheduler,
                      std::pmr::memory_resource& memory) {
  WideTopology wide(topology.references(), memory);
  Roots roots{std::pmr::vector<const TopologyNode*>(&memory), std::pmr::vector<uint32_t>(&memory)};
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
    Part& part = wide.subtrees[i];
    part.first_node = wide.node_count;
    part.first_block = wide.block_count;
    wide.node_count += part.nodes.size();
    wide.block_count += part.block_count;
    wide.reference_count += part.reference_count;
    wide.depth = std::max(wide.depth, roots.depths[i] + part.depth);
    const auto [node, child] = wide.places[i];
    wide.top.nodes[node].index[child] = static_cast<uint32_t>(part.first_node);
  }
  if (wide.depth > kMaxDepth) {
    fail(SOBB_ERROR_INTERNAL, "the topology is %u nodes deep, more than %u", wide.depth, kMaxDepth);
  }
  scheduler.for_each(wide.subtrees.size(), [&](uint64_t i) { relocate(wide.subtrees[i]); });
  return wide;
}

}  // namespace sobb
