// SPDX-License-Identifier: Apache-2.0
#include "study/areas/node_sample.h"

namespace sobb::study {
namespace {

NodeKind kind_of(const TopologyNode& node) {
  if (node.is_leaf) return NodeKind::kLeaf;
  return node.count <= kLargestSmallNode ? NodeKind::kSmallInner : NodeKind::kLargeInner;
}

// Calls visit(node) for every node but the root, parents first.
template <class Visit>
void for_nodes(const Topology& topology, const Visit& visit) {
  for (const NodePair& pair : topology.pairs()) {
    for (const TopologyNode& node : pair.child) visit(node);
  }
}

}  // namespace

std::string_view name_of(NodeKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"leaf", "small inner", "large inner"};
  return kNames[static_cast<size_t>(kind)];
}

NodeSample sample_nodes(const Topology& topology, NodeKind kind, uint32_t draws, uint64_t largest) {
  const auto wanted = [&](const TopologyNode& node) {
    return kind_of(node) == kind && node.count <= largest;
  };
  NodeSample sample;
  for_nodes(topology, [&](const TopologyNode& node) {
    if (!wanted(node)) return;
    ++sample.count;
    sample.box_area += 2 * node.box.half_area();
  });
  // Draw i falls at (i + 1/2) / draws of the running sum.
  double sum = 0;
  for_nodes(topology, [&](const TopologyNode& node) {
    if (!wanted(node)) return;
    sum += 2 * node.box.half_area();
    uint32_t times = 0;
    for (; sample.draws < draws && (sample.draws + 0.5) * sample.box_area < sum * draws; ++times) {
      ++sample.draws;
    }
    if (times > 0) sample.nodes.push_back({&node, times});
  });
  return sample;
}

}  // namespace sobb::study
