// SPDX-License-Identifier: Apache-2.0
// Nodes of a binary topology, drawn in proportion to the area of their boxes: the mean over a
// sample of a volume's area over its box's is then the ratio of the sums over all nodes, which is
// what the surface area heuristic, and the paper's table, count.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "builder/topology/topology.h"

namespace sobb::study {

enum class NodeKind { kLeaf, kSmallInner, kLargeInner };
inline constexpr std::array kNodeKinds{NodeKind::kLeaf, NodeKind::kSmallInner,
                                       NodeKind::kLargeInner};
inline constexpr uint64_t kLargestSmallNode = 64;  // triangles below it

std::string_view name_of(NodeKind kind);

struct SampledNode {
  const TopologyNode* node;
  uint32_t times;  // drawn
};

struct NodeSample {
  uint64_t count = 0;   // all nodes of the kind but the root
  double box_area = 0;  // sum of their boxes' areas
  uint32_t draws = 0;
  std::vector<SampledNode> nodes;
};

// Systematic sampling in the order of the tree: spread over it, and without random numbers. Nodes
// of more than `largest` triangles are left out.
NodeSample sample_nodes(const Topology& topology, NodeKind kind, uint32_t draws, uint64_t largest);

}  // namespace sobb::study
