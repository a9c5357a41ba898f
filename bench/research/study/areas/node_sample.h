// SPDX-License-Identifier: Apache-2.0
// sample_nodes() draws nodes of a binary topology in proportion to the area of their boxes. The
// mean ratio of a volume's area to its box's is then the ratio of the sums over all nodes, which
// the surface area heuristic and the paper's table count.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "builder/topology/topology.h"

namespace sobb::study {

enum class NodeKind { kLeaf, kSmallInner, kLargeInner };
inline constexpr std::array kNodeKinds{NodeKind::kLeaf, NodeKind::kSmallInner,
                                       NodeKind::kLargeInner};
inline constexpr uint64_t kLargestSmallNode = 64;  // triangles below the node

std::string_view name_of(NodeKind kind);

struct SampledNode {
  const TopologyNode* node;
  uint32_t times;  // how often it was drawn
};

struct NodeSample {
  uint64_t count = 0;   // all nodes of the kind but the root
  double box_area = 0;  // sum of their boxes' areas
  uint32_t draws = 0;
  std::vector<SampledNode> nodes;
};

// Samples systematically in the order of the tree: spread over it, without random numbers. Nodes
// of more than `largest` triangles are left out.
NodeSample sample_nodes(const Topology& topology, NodeKind kind, uint32_t draws, uint64_t largest);

}  // namespace sobb::study
