// SPDX-License-Identifier: Apache-2.0
#include "build/collapse.h"

#include <algorithm>

#include "base/error.h"
#include "build/least_cost_cut.h"
#include "format/layout.h"

namespace sobb {
namespace {

// A subtree has at most this part of the references, or this many: enough subtrees to share among
// threads, each large enough to be worth a task.
constexpr uint64_t kSubtreeParts = 256;
constexpr uint64_t kSubtreeReferences = 4096;

const InnerNode& inner(const TopologyNode* node) { return *static_cast<const InnerNode*>(node); }

// The children of a wide node of the top, where its subtrees are yet unknown: the largest is opened
// until there are enough. The order is the binary one's.
void gather_children(const TopologyNode& root, uint32_t width, WideNode& wide) {
  wide.child_count = 1;
  wide.child[0] = &root;
  if (root.is_leaf) return;
  double area[kMaxWidth] = {1};
  while (wide.child_count < width) {
    uint32_t widest = kMaxWidth;
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (!wide.child[i]->is_leaf && (widest == kMaxWidth || area[i] > area[widest])) widest = i;
    }
    if (widest == kMaxWidth) return;
    const InnerNode& opened = inner(wide.child[widest]);
    std::copy_backward(wide.child + widest + 1, wide.child + wide.child_count,
                       wide.child + wide.child_count + 1);
    std::copy_backward(area + widest + 1, area + wide.child_count, area + wide.child_count + 1);
    for (uint32_t i = 0; i < 2; ++i) {
      wide.child[widest + i] = opened.child[i];
      area[widest + i] = opened.box[i].half_area();
    }
    ++wide.child_count;
  }
}

// Collapses what lies below a binary node, depth first, siblings next to each other.
void collapse_subtree(const TopologyNode& root, uint32_t width, Part& part) {
  struct Open {
    uint32_t place;  // in the cut
    uint32_t index;
    uint32_t depth;
  };
  const LeastCostCut cut(root, width, *part.nodes.get_allocator().resource());
  std::pmr::vector<Open> stack(part.nodes.get_allocator());
  stack.push_back({LeastCostCut::kRoot, 0, 1});
  part.nodes.resize(1);
  while (!stack.empty()) {
    const Open open = stack.back();
    stack.pop_back();
    part.depth = std::max(part.depth, open.depth);
    WideNode wide;
    uint32_t place[kMaxWidth];
    wide.child_count = cut.children(open.place, wide.child, place);
    for (uint32_t i = 0; i < wide.child_count; ++i) {
      if (wide.child[i]->is_leaf) {
        wide.index[i] = static_cast<uint32_t>(part.block_count);
        part.block_count += blocks_of(wide.child[i]->reference_count);
      } else {
        wide.index[i] = static_cast<uint32_t>(part.nodes.size());
        part.nodes.emplace_back();
      }
    }
    for (uint32_t i = wide.child_count; i-- > 0;) {
      if (!wide.child[i]->is_leaf) stack.push_back({place[i], wide.index[i], open.depth + 1});
    }
    part.nodes[open.index] = wide;
  }
}

// Collapses the top, breadth first and greedily, down to children small enough to be subtrees.
// `depths` says how many nodes lie above each of those.
void collapse_top(const TopologyNode& root, uint32_t width, WideTopology& wide,
                  std::pmr::vector<uint32_t>& depths) {
  const uint64_t limit =
      std::max<uint64_t>(kSubtreeReferences, root.reference_count / kSubtreeParts);
  std::pmr::vector<const TopologyNode*> queue({&root}, wide.top.nodes.get_allocator());
  std::pmr::vector<uint32_t> depth({1U}, wide.top.nodes.get_allocator());
  for (size_t next = 0; next < queue.size(); ++next) {
    WideNode node;
    gather_children(*queue[next], width, node);
    wide.top.depth = std::max(wide.top.depth, depth[next]);
    for (uint32_t i = 0; i < node.child_count; ++i) {
      const TopologyNode* child = node.child[i];
      if (child->is_leaf) {
        node.index[i] = static_cast<uint32_t>(wide.top.block_count);
        wide.top.block_count += blocks_of(child->reference_count);
      } else if (child->reference_count > limit) {
        node.index[i] = static_cast<uint32_t>(queue.size());
        queue.push_back(child);
        depth.push_back(depth[next] + 1);
      } else {
        node.index[i] = 0;  // known once the subtrees before it are
        wide.places.push_back({static_cast<uint32_t>(next), i});
        depths.push_back(depth[next]);
      }
    }
    wide.top.nodes.push_back(node);
  }
}

// Turns a part's own indices into the file's.
void relocate(Part& part) {
  for (WideNode& node : part.nodes) {
    for (uint32_t i = 0; i < node.child_count; ++i) {
      node.index[i] +=
          static_cast<uint32_t>(node.child[i]->is_leaf ? part.first_block : part.first_node);
    }
  }
}

}  // namespace

WideTopology collapse(const TopologyNode& root, uint32_t width, const Scheduler& scheduler,
                      std::pmr::memory_resource& memory) {
  WideTopology wide(memory);
  std::pmr::vector<uint32_t> depths(&memory);
  collapse_top(root, width, wide, depths);
  for (size_t i = 0; i < wide.places.size(); ++i) wide.subtrees.emplace_back(memory);
  scheduler.for_each(wide.subtrees.size(), [&](uint64_t i) {
    const auto [node, child] = wide.places[i];
    collapse_subtree(*wide.top.nodes[node].child[child], width, wide.subtrees[i]);
  });

  wide.depth = wide.top.depth;
  wide.node_count = wide.top.nodes.size();
  wide.block_count = wide.top.block_count;
  for (size_t i = 0; i < wide.subtrees.size(); ++i) {
    Part& part = wide.subtrees[i];
    part.first_node = wide.node_count;
    part.first_block = wide.block_count;
    wide.node_count += part.nodes.size();
    wide.block_count += part.block_count;
    wide.depth = std::max(wide.depth, depths[i] + part.depth);
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
