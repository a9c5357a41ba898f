// SPDX-License-Identifier: Apache-2.0
#include "build/least_cost_cut.h"

namespace sobb {

LeastCostCut::LeastCostCut(const TopologyNode& root, uint32_t width,
                           std::pmr::memory_resource& memory)
    : width_(width), binary_(&memory) {
  binary_.reserve(root.reference_count);
  binary_.push_back({&root, 0, {}, {}, {}, {}});
  for (uint32_t at = 0; at < binary_.size(); ++at) {
    if (binary_[at].node->is_leaf) continue;
    const auto& inner = *static_cast<const InnerNode*>(binary_[at].node);
    for (int side = 0; side < 2; ++side) {
      binary_[at].child[side] = static_cast<uint32_t>(binary_.size());
      binary_.push_back({inner.child[side], inner.box[side].half_area(), {}, {}, {}, {}});
    }
  }
  for (size_t at = binary_.size(); at-- > 0;) {
    if (!binary_[at].node->is_leaf) solve(binary_[at]);
  }
}

void LeastCostCut::solve(Binary& binary) const {
  const Binary& left = binary_[binary.child[0]];
  const Binary& right = binary_[binary.child[1]];
  double shared_out[kMaxWidth + 1] = {};
  Shares best[kMaxWidth + 1];
  for (uint32_t trees = 2; trees <= width_; ++trees) {
    for (uint32_t j = 1; j < trees; ++j) {
      const double cost = left.cost[j] + right.cost[trees - j];
      if (j > 1 && !(cost < shared_out[trees])) continue;
      shared_out[trees] = cost;
      best[trees] = {static_cast<uint8_t>(j), static_cast<uint8_t>(trees - j)};
    }
  }
  binary.opened = best[width_];
  binary.cost[1] = binary.area + shared_out[width_];
  for (uint32_t trees = 2; trees <= width_; ++trees) {
    const bool more = shared_out[trees] < binary.cost[trees - 1];
    binary.cost[trees] = more ? shared_out[trees] : binary.cost[trees - 1];
    binary.shares[trees] = more ? best[trees] : binary.shares[trees - 1];
  }
}

uint32_t LeastCostCut::children(uint32_t at, const TopologyNode* child[kMaxWidth],
                                uint32_t place[kMaxWidth]) const {
  uint32_t count = 0;
  gather(at, binary_[at].opened, child, place, count);
  return count;
}

void LeastCostCut::gather(uint32_t at, Shares shares, const TopologyNode* child[kMaxWidth],
                          uint32_t place[kMaxWidth], uint32_t& count) const {
  const Binary& binary = binary_[at];
  if (shares.left == 0) {
    child[count] = binary.node;
    place[count++] = at;
    return;
  }
  const Binary& left = binary_[binary.child[0]];
  const Binary& right = binary_[binary.child[1]];
  gather(binary.child[0], left.shares[shares.left], child, place, count);
  gather(binary.child[1], right.shares[shares.right], child, place, count);
}

}  // namespace sobb
