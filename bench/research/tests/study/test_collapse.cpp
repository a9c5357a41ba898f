// SPDX-License-Identifier: Apache-2.0
// The exact collapse costs the least of all possible ones; the greedy one and the choice of leaves
// keep their limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "builder/boxes/references.h"
#include "study/binary/leaf_choice.h"
#include "study/binary/sah_costs.h"
#include "study/wide/exact_collapse.h"
#include "study/wide/greedy_collapse.h"
#include "support/soups.h"

namespace sobb::study {
namespace {

using test::Random;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

uint32_t grow(Random& random, uint32_t leaves, BinaryTree& tree) {
  const auto at = static_cast<uint32_t>(tree.nodes.size());
  tree.nodes.push_back({{0, 0}, static_cast<uint32_t>(tree.references.size()), 0});
  if (leaves == 1) {
    tree.nodes[at].count = 1 + random.below(4);
    tree.references.resize(tree.references.size() + tree.nodes[at].count);
    return at;
  }
  const uint32_t first = 1 + random.below(leaves - 1);
  const uint32_t child = grow(random, first, tree);
  const uint32_t other = grow(random, leaves - first, tree);
  BinaryNode& node = tree.nodes[at];
  node.child[0] = child;
  node.child[1] = other;
  node.count = tree.nodes[child].count + tree.nodes[other].count;
  return at;
}

// Arbitrary areas, such as no volume has.
std::vector<float> random_areas(Random& random, const BinaryTree& tree) {
  std::vector<float> areas(tree.nodes.size());
  for (float& area : areas) area = random.between(0.1, 2);
  return areas;
}

uint32_t roots_below(const BinaryTree& tree, const WideCut& cut, uint32_t at) {
  uint32_t roots = 0;
  for (const uint32_t child : tree.nodes[at].child) {
    roots += cut[child] == Role::kInside ? roots_below(tree, cut, child) : 1;
  }
  return roots;
}

// The cost of what lies below a node, infinite where the cut is not possible.
float cost_of(const BinaryTree& tree, const WideCut& cut, const std::vector<float>& areas,
              uint32_t width, Leaves leaves, uint32_t at = 0) {
  const BinaryNode& node = tree.nodes[at];
  if (cut[at] == Role::kLeaf) {
    const bool possible = node.is_leaf() || (leaves == Leaves::kChosen && at != 0 &&
                                             node.count <= kMaxLeafReferences);
    return possible ? areas[at] * triangles_cost(node.count) : kInfinity;
  }
  if (node.is_leaf()) return kInfinity;
  if (cut[at] == Role::kWide && roots_below(tree, cut, at) > width) return kInfinity;
  return (cut[at] == Role::kWide ? kWideNodeCost * areas[at] : 0) +
         cost_of(tree, cut, areas, width, leaves, node.child[0]) +
         cost_of(tree, cut, areas, width, leaves, node.child[1]);
}

// (Inlined, GCC 12 takes the cut for a pointer that it may not free.)
[[gnu::noinline]] float least_cost(const BinaryTree& tree, const std::vector<float>& areas,
                                   uint32_t width, Leaves leaves) {
  WideCut cut(tree.nodes.size(), Role::kInside);
  cut[0] = Role::kWide;
  float least = kInfinity;
  size_t next = 0;
  while (next < cut.size()) {
    least = std::min(least, cost_of(tree, cut, areas, width, leaves));
    for (next = 1; next < cut.size(); ++next) {  // counts in base three
      if (cut[next] != Role::kLeaf) break;
      cut[next] = Role::kInside;
    }
    if (next < cut.size()) cut[next] = static_cast<Role>(static_cast<int>(cut[next]) + 1);
  }
  return least;
}

TEST(Collapse, ExactIsTheLeastOfAll) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    BinaryTree tree;
    grow(random, 2 + random.below(4), tree);
    const auto areas = random_areas(random, tree);
    for (const uint32_t width : {2U, 3U, 4U, 8U}) {
      for (const Leaves leaves : {Leaves::kKept, Leaves::kChosen}) {
        const WideCut cut = collapse_exactly(tree, areas, width, leaves);
        EXPECT_FLOAT_EQ(cost_of(tree, cut, areas, width, leaves),
                        least_cost(tree, areas, width, leaves));
      }
    }
  }
}

TEST(Collapse, GreedyFillsNodesAndIsNeverBetterThanExact) {
  Random random(1);
  BinaryTree tree;
  grow(random, 300, tree);
  const auto areas = random_areas(random, tree);
  for (const uint32_t width : {2U, 4U, 8U}) {
    const WideCut greedy = collapse_greedily(tree, areas, width);
    const WideCut exact = collapse_exactly(tree, areas, width, Leaves::kKept);
    EXPECT_EQ(roots_below(tree, greedy, 0), width);
    EXPECT_LE(cost_of(tree, exact, areas, width, Leaves::kKept),
              cost_of(tree, greedy, areas, width, Leaves::kKept) * (1 + 1e-5F));
  }
}

TEST(LeafChoice, KeepsTheReferencesAndTheLimit) {
  Random random(2);
  BinaryTree tree;
  grow(random, 500, tree);
  const BinaryTree chosen = choose_leaves(tree, random_areas(random, tree));
  uint32_t next = 0;
  for (const BinaryNode& node : chosen.nodes) {
    if (!node.is_leaf()) continue;
    EXPECT_EQ(node.first, next);
    EXPECT_LE(node.count, kMaxLeafReferences);
    next += node.count;
  }
  EXPECT_EQ(next, tree.references.size());
  EXPECT_LT(chosen.nodes.size(), tree.nodes.size());
}

}  // namespace
}  // namespace sobb::study
