// SPDX-License-Identifier: Apache-2.0
#include "node_sample.h"

namespace sobb::study {
namespace {

NodeKind kind_of(const TopologyNode& node) {
  if (node.is_leaf) return NodeKind::kLeaf;
  return node.reference_count <= kLargestSmallNode ? NodeKind::kSmallInner : NodeKind::kLargeInner;
}

// visit(node, box) for every node below, parents first.
template <class Visit>
void for_nodes_below(const TopologyNode& node, const Visit& visit) {
  if (node.is_leaf) return;
  const auto& inner = static_cast<const InnerNode&>(node);
  for (int i = 0; i < 2; ++i) {
    visit(*inner.child[i], inner.box[i]);
    for_nodes_below(*inner.child[i], visit);
  }
}

}  // namespace

std::string_view name_of(NodeKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"leaf", "small inner", "large inner"};
  return kNames[static_cast<size_t>(kind)];
}

NodeSample sample_nodes(const TopologyNode& root, NodeKind kind, uint32_t draws, uint64_t largest) {
  const auto wanted = [&](const TopologyNode& node) {
    return kind_of(node) == kind && node.reference_count <= largest;
  };
  NodeSample sample;
  for_nodes_below(root, [&](const TopologyNode& node, const Box& box) {
    if (!wanted(node)) return;
    ++sample.count;
    sample.box_area += 2 * box.half_area();
  });
  // Draw i falls at (i + 1/2) / draws of the running sum.
  double sum = 0;
  for_nodes_below(root, [&](const TopologyNode& node, const Box& box) {
    if (!wanted(node)) return;
    sum += 2 * box.half_area();
    uint32_t times = 0;
    for (; sample.draws < draws && (sample.draws + 0.5) * sample.box_area < sum * draws; ++times) {
      ++sample.draws;
    }
    if (times > 0) sample.nodes.push_back({&node, box, times});
  });
  return sample;
}

}  // namespace sobb::study
