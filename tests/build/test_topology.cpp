// SPDX-License-Identifier: Apache-2.0
// Topology: every triangle in a leaf, boxes that hold what is below, the same tree for any number
// of threads.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "build/sampled_triangle.h"
#include "build/topology.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

constexpr sobb_quality kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};

// A topology with all that it borrows.
struct Tree {
  Scheduler scheduler;
  Mesh mesh;
  Memory memory;
  Progress progress{nullptr, nullptr};
  Topology topology;

  Tree(const Soup& soup, sobb_quality quality, uint32_t threads)
      : scheduler(threads, nullptr),
        mesh(soup.view(), scheduler),
        topology(mesh, quality, scheduler, memory, progress, 1) {}
};

bool same(const TopologyNode* a, const TopologyNode* b) {
  if (a->is_leaf != b->is_leaf || a->reference_count != b->reference_count) return false;
  if (a->is_leaf) {
    const Reference* of_a = static_cast<const LeafNode*>(a)->references;
    const Reference* of_b = static_cast<const LeafNode*>(b)->references;
    return std::equal(of_a, of_a + a->reference_count, of_b,
                      [](const Reference& x, const Reference& y) {
                        return x.primitive == y.primitive && x.box == y.box;
                      });
  }
  const auto* inner_a = static_cast<const InnerNode*>(a);
  const auto* inner_b = static_cast<const InnerNode*>(b);
  for (int i = 0; i < 2; ++i) {
    if (!(inner_a->box[i] == inner_b->box[i])) return false;
    if (!same(inner_a->child[i], inner_b->child[i])) return false;
  }
  return true;
}

// Walks down; collects references, checks counts.
uint64_t collect(const TopologyNode* node, std::vector<Reference>& references) {
  uint64_t count = 0;
  if (node->is_leaf) {
    const auto* leaf = static_cast<const LeafNode*>(node);
    EXPECT_GE(leaf->reference_count, 1u);
    EXPECT_LE(leaf->reference_count, kMaxLeafReferences);
    references.insert(references.end(), leaf->references, leaf->references + leaf->reference_count);
    count = leaf->reference_count;
  } else {
    for (const TopologyNode* child : static_cast<const InnerNode*>(node)->child) {
      count += collect(child, references);
    }
  }
  EXPECT_EQ(node->reference_count, count);
  return count;
}

TEST(Topology, HoldsEveryPointOfEveryTriangle) {
  for (const Soup& soup : {random_soup(1, 3000), random_soup(2, 400, 1.5), sliver_soup(3, 1000),
                           degenerate_soup(4, 500), random_soup(5, 1), identical_soup(100)}) {
    for (const sobb_quality quality : kQualities) {
      SCOPED_TRACE(soup.name + " quality " + std::to_string(quality));
      const Tree tree(soup, quality, 1);
      std::vector<Reference> references;
      collect(tree.topology.root(), references);
      std::vector<std::vector<Box>> boxes(tree.mesh.triangle_count());
      for (const Reference& reference : references) {
        boxes.at(reference.primitive).push_back(reference.box);
      }
      for (uint64_t t = 0; t < boxes.size(); ++t) {
        const Corners corners(tree.mesh, t);
        if (quality != SOBB_QUALITY_HIGH) {
          ASSERT_EQ(boxes[t].size(), 1u) << "triangle " << t;
          ASSERT_TRUE(boxes[t][0] == corners.box()) << "triangle " << t;
          continue;
        }
        for (const Sample& p : sample_triangle(corners)) {
          const bool held = std::any_of(boxes[t].begin(), boxes[t].end(), [&](const Box& box) {
            return p.at[0] >= box.lower[0] && p.at[0] <= box.upper[0] && p.at[1] >= box.lower[1] &&
                   p.at[1] <= box.upper[1] && p.at[2] >= box.lower[2] && p.at[2] <= box.upper[2];
          });
          ASSERT_TRUE(held) << "triangle " << t;
        }
      }
    }
  }
}

TEST(Topology, SpatialSplitsCutLargeTriangles) {
  const Tree medium(random_soup(6, 500, 1.5), SOBB_QUALITY_MEDIUM, 1);
  const Tree high(random_soup(6, 500, 1.5), SOBB_QUALITY_HIGH, 1);
  EXPECT_EQ(medium.topology.root()->reference_count, 500u);
  EXPECT_GT(high.topology.root()->reference_count, 500u);
}

TEST(Topology, IsTheSameForAnyThreadCount) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const Soup& soup : {random_soup(7, 8'000), sliver_soup(8, 4'000), identical_soup(10'000)}) {
    for (const sobb_quality quality : kQualities) {
      const Tree one(soup, quality, 1);
      for (const uint32_t threads : {2, 3, 8}) {
        const Tree other(soup, quality, threads);
        EXPECT_TRUE(same(one.topology.root(), other.topology.root()))
            << soup.name << " quality " << quality << " threads " << threads;
      }
    }
  }
}

}  // namespace
}  // namespace sobb::test
