// SPDX-License-Identifier: Apache-2.0
// Wide nodes hold every reference in one leaf, have the depths and counts that are stated, and
// order children by rising area per triangle.
#include "builder/wide/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "builder/topology/topology.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

struct Subtree {
  Box box;
  uint64_t count;
  uint32_t depth;
};

// Walks the nodes in the layout that the file will have.
class Walker {
 public:
  Walker(const WideTopology& wide, const Mesh& mesh)
      : references_(wide.references), mesh_(mesh), met_(references_.primitives.size()) {
    nodes_.assign(wide.top.nodes.begin(), wide.top.nodes.end());
    for (const Treelet& treelet : wide.subtrees) {
      EXPECT_EQ(treelet.first_node, nodes_.size());
      nodes_.insert(nodes_.end(), treelet.nodes.begin(), treelet.nodes.end());
    }
  }

  Subtree walk(uint32_t index = 0) {
    const WideNode& node = nodes_.at(index);
    EXPECT_GE(node.child_count, 1U);
    Subtree all{kNowhere, 0, 0};
    double before = 0;
    for (uint32_t i = 0; i < node.child_count; ++i) {
      const Subtree child = node.is_leaf(i) ? leaf(node, i) : walk(node.index[i]);
      const double area = child.box.half_area() / static_cast<double>(child.count);
      EXPECT_LE(before, area) << "node " << index << ", child " << i;
      before = area;
      all.box.grow(child.box);
      all.count += child.count;
      all.depth = std::max(all.depth, child.depth);
    }
    ++all.depth;
    return all;
  }

  bool met_each_once() const {
    return std::all_of(met_.begin(), met_.end(), [](uint32_t times) { return times == 1; });
  }
  size_t node_count() const { return nodes_.size(); }

 private:
  static constexpr float kFar = std::numeric_limits<float>::infinity();
  static constexpr Box kNowhere{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};

  Subtree leaf(const WideNode& node, uint32_t i) {
    Subtree all{kNowhere, node.count[i], 0};
    for (uint32_t at = node.first[i]; at < node.first[i] + node.count[i]; ++at) {
      ++met_.at(at);
      all.box.grow(references_.is_cut(at) ? references_.cuts[at]
                                          : Corners(mesh_, references_.primitives[at]).box());
    }
    return all;
  }

  References references_;
  const Mesh& mesh_;
  std::vector<WideNode> nodes_;
  std::vector<uint32_t> met_;  // how often, by reference
};

TEST(Collapse, OrdersChildrenByAreaPerTriangle) {
  for (const Soup& soup : {random_soup(1, 20'000), random_soup(2, 400, 1.5), sliver_soup(3, 9'000),
                           identical_soup(100), degenerate_soup(4, 500), random_soup(5, 1),
                           placed(random_soup(6, 400, 1.5), 0x1p50, 1e3)}) {
    for (const uint32_t width : {2U, 4U, 8U}) {
      SCOPED_TRACE(soup.name + ", width " + std::to_string(width));
      const Scheduler scheduler(1, nullptr);
      const Mesh mesh(soup.view(), scheduler);
      Memory memory;
      Progress progress(nullptr, nullptr);
      const Topology topology(mesh, SOBB_QUALITY_MEDIUM, scheduler, memory, progress, 1, Frame(),
                              SOBB_ISA_BEST);
      const WideTopology wide = collapse(topology, width, scheduler, memory);
      Walker walker(wide, mesh);
      const Subtree all = walker.walk();
      EXPECT_TRUE(walker.met_each_once());
      EXPECT_EQ(walker.node_count(), wide.node_count);
      EXPECT_EQ(all.count, wide.reference_count);
      EXPECT_EQ(all.depth, wide.depth);
    }
  }
}

}  // namespace
}  // namespace sobb::test
