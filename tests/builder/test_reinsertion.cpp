// SPDX-License-Identifier: Apache-2.0
// Reinsertion keeps the leaves under smaller boxes, and makes the same tree for any number of
// threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "builder/topology/reinsertion.h"
#include "format/layout.h"
#include "support/soups.h"

namespace sobb::test {
namespace {

constexpr ReinsertionEffort kAll = {4, 1};

// Makes a tree over leaves in the order they come in: halves at every node, or a chain, where every
// left child is a leaf.
class TreeMaker {
 public:
  TreeMaker(const std::vector<Box>& leaves, bool chain, Memory& memory)
      : leaves_(leaves), chain_(chain) {
    nodes_.pairs = Array<NodePair>(leaves.size() - 1, memory);
  }

  BinaryNodes make() {
    nodes_.root = node(0, static_cast<uint32_t>(leaves_.size()));
    return std::move(nodes_);
  }

 private:
  TopologyNode node(uint32_t first, uint32_t count) {
    TopologyNode made = {leaves_[first], first, 1, 1};
    if (count == 1) return made;
    const uint32_t pair = next_++;
    const uint32_t left = chain_ ? 1 : count / 2;
    nodes_.pairs[pair].child[0] = node(first, left);
    nodes_.pairs[pair].child[1] = node(first + left, count - left);
    made = nodes_.pairs[pair].child[0];
    made.box.grow(nodes_.pairs[pair].child[1].box);
    made.first = pair;
    made.count = count;
    made.is_leaf = 0;
    return made;
  }

  const std::vector<Box>& leaves_;
  bool chain_;
  uint32_t next_ = 0;
  BinaryNodes nodes_;
};

std::vector<Box> random_boxes(uint64_t seed, uint32_t count, double size) {
  Random random(seed);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = random.between(-1, 1);
      box.upper[k] = box.lower[k] + random.between(0, size);
    }
  }
  return boxes;
}

struct Walk {
  std::vector<uint32_t> met;  // how often each leaf was met
  double area = 0;            // half the area of inner nodes
  uint32_t next_pair = 0;
  uint32_t depth = 0;
};

void walk_down(const BinaryNodes& nodes, const TopologyNode& node, const std::vector<Box>& leaves,
               uint32_t depth, Walk& walk) {
  walk.depth = std::max(walk.depth, depth);
  if (node.is_leaf) {
    ++walk.met.at(node.first);
    ASSERT_TRUE(node.box == leaves[node.first]);
    return;
  }
  walk.area += node.box.half_area();
  ASSERT_EQ(node.first, walk.next_pair++);
  const NodePair& pair = nodes.pairs[node.first];
  ASSERT_EQ(node.count, pair.count());
  Box both = pair.child[0].box;
  both.grow(pair.child[1].box);
  ASSERT_TRUE(node.box == both);
  for (const TopologyNode& child : pair.child) {
    walk_down(nodes, child, leaves, depth + 1, walk);
    if (testing::Test::HasFatalFailure()) return;
  }
}

Walk walk(const BinaryNodes& nodes, const std::vector<Box>& leaves) {
  Walk walk{std::vector<uint32_t>(leaves.size())};
  walk_down(nodes, nodes.root, leaves, 0, walk);
  EXPECT_TRUE(std::all_of(walk.met.begin(), walk.met.end(), [](uint32_t n) { return n == 1; }));
  return walk;
}

class Reinsertion : public testing::Test {
 protected:
  BinaryNodes tree(const std::vector<Box>& leaves, bool chain = false) {
    return TreeMaker(leaves, chain, memory_).make();
  }
  void reinsert(BinaryNodes& nodes, uint32_t threads = 1, ReinsertionEffort effort = kAll) {
    Progress progress(nullptr, nullptr);
    ProgressStage stage(progress, 0, 1, effort.rounds);
    sobb::reinsert(nodes, effort, Scheduler(threads, nullptr), memory_, stage);
  }

  Memory memory_;
};

TEST_F(Reinsertion, KeepsTheLeavesUnderSmallerBoxes) {
  for (const uint32_t count : {3U, 4U, 10U, 100U, 2000U}) {
    for (const double size : {0.0, 0.05, 1.0}) {
      SCOPED_TRACE(std::to_string(count) + " boxes of " + std::to_string(size));
      const std::vector<Box> leaves = random_boxes(count, count, size);
      BinaryNodes nodes = tree(leaves);
      const double before = walk(nodes, leaves).area;
      reinsert(nodes);
      const double after = walk(nodes, leaves).area;
      if (HasFatalFailure()) return;
      EXPECT_LE(after, before);
      if (count >= 100 && size < 1) {
        EXPECT_LT(after, 0.5 * before);
      }
    }
  }
}

// Two pairs of neighbours, far from each other, are paired the wrong way.
TEST_F(Reinsertion, PutsNeighboursTogether) {
  const auto unit_at = [](float x) { return Box{{x, 0, 0}, {x + 1, 1, 1}}; };
  const std::vector<Box> leaves = {unit_at(0), unit_at(10), unit_at(1), unit_at(11)};
  BinaryNodes nodes = tree(leaves);
  reinsert(nodes);
  EXPECT_EQ(walk(nodes, leaves).area, (12 + 12 + 1) + 2 * (2 + 2 + 1));
}

TEST_F(Reinsertion, LeavesWhatHasNoBetterPlace) {
  for (const uint32_t count : {1U, 2U}) {
    const std::vector<Box> leaves = random_boxes(1, count, 0.1);
    BinaryNodes nodes = tree(leaves);
    reinsert(nodes);
    walk(nodes, leaves);
  }
  const std::vector<Box> same(500, Box{{0, 0, 0}, {1, 1, 1}});
  BinaryNodes nodes = tree(same);
  reinsert(nodes);
  EXPECT_EQ(walk(nodes, same).area, 499 * 3);
}

TEST_F(Reinsertion, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Box> leaves = random_boxes(7, 3000, 0.05);
  for (const ReinsertionEffort effort : {kAll, ReinsertionEffort{2, 0.1}}) {
    BinaryNodes one = tree(leaves);
    BinaryNodes three = tree(leaves);
    reinsert(one, 1, effort);
    reinsert(three, 3, effort);
    ASSERT_TRUE(one.root.box == three.root.box);
    for (size_t i = 0; i < one.pairs.size(); ++i) {
      for (int side = 0; side < 2; ++side) {
        const TopologyNode& a = one.pairs[i].child[side];
        const TopologyNode& b = three.pairs[i].child[side];
        ASSERT_TRUE(a.box == b.box && a.first == b.first && a.count == b.count &&
                    a.is_leaf == b.is_leaf);
      }
    }
  }
}

// The chain is as deep as files may be, and of boxes that grow: moving one further down deepens it.
TEST_F(Reinsertion, MakesNoTreeTooDeep) {
  for (const bool rising : {false, true}) {
    std::vector<Box> leaves(kMaxDepth + 1);
    for (size_t i = 0; i < leaves.size(); ++i) {
      const auto size = static_cast<float>(rising ? i + 1 : leaves.size() - i);
      leaves[i] = {{-size, -size, -size}, {size, size, size}};
    }
    std::rotate(leaves.begin(), leaves.begin() + 40, leaves.end());
    BinaryNodes nodes = tree(leaves, true);
    reinsert(nodes);
    EXPECT_LE(walk(nodes, leaves).depth, kMaxDepth);
  }
}

}  // namespace
}  // namespace sobb::test
