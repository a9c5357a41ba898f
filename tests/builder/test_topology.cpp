// SPDX-License-Identifier: Apache-2.0
// A topology has every triangle in a leaf, in boxes that hold all below them, and is the same for
// any number of threads and any instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "builder/sampled_triangle.h"
#include "builder/topology/topology.h"
#include "format/layout.h"
#include "support/more_threads.h"
#include "support/soups.h"
#include "support/supported_isas.h"

namespace sobb::test {
namespace {

constexpr sobb_quality kQualities[] = {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH};

Soup flat_soup(uint64_t seed, uint32_t triangles) {
  Soup soup = random_soup(seed, triangles, 1.5);
  for (size_t i = 2; i < soup.vertices.size(); i += 3) soup.vertices[i] = 0.5F;
  soup.name = "flat";
  return soup;
}

// Small triangles all over a cube, and a few long ones through them, which fit into no small box.
Soup needle_soup(uint64_t seed, uint32_t triangles) {
  Soup soup = random_soup(seed, triangles, 0.02);
  soup.name = "needles";
  Random random(seed);
  for (uint32_t i = 0; i < triangles / 50; ++i) {
    float a[3];
    float b[3];
    float c[3];
    for (int k = 0; k < 3; ++k) {
      a[k] = random.between(0, 1);
      b[k] = a[k] + random.between(0, 1e-3);
      c[k] = random.between(0, 1);
    }
    soup.add(a, b, c);
  }
  return soup;
}

// Triangles of all sizes from 1 down to a power of two, about one point.
Soup shrinking_soup(uint64_t seed, uint32_t triangles, double least_exponent) {
  Soup soup;
  soup.name = "shrinking by 2^" + std::to_string(least_exponent);
  Random random(seed);
  for (uint32_t i = 0; i < triangles; ++i) {
    const double size = std::exp2(least_exponent * random.uniform());
    float corner[3][3];
    for (float(&point)[3] : corner) {
      for (float& x : point) x = random.between(-size, size);
    }
    soup.add(corner[0], corner[1], corner[2]);
  }
  return soup;
}

// Most triangles lie in one cell of any grid over all of them, so that it needs a grid of its own.
Soup clustered_soup(uint64_t seed, uint32_t triangles) {
  Soup soup = placed(random_soup(seed, triangles, 0.05), 1e-4, 0.3);
  soup.name = "clustered";
  const Soup around = random_soup(seed + 1, triangles / 20, 0.01);
  for (uint64_t i = 0; i < around.indices.size() / 3; ++i) {
    soup.add(around.corner(i, 0), around.corner(i, 1), around.corner(i, 2));
  }
  return soup;
}

// A topology, and all that it borrows.
struct Tree {
  Scheduler scheduler;
  Mesh mesh;
  Memory memory;
  Progress progress{nullptr, nullptr};
  Topology topology;

  Tree(const Soup& soup, sobb_quality quality, uint32_t threads, sobb_isa isa = SOBB_ISA_BEST)
      : scheduler(threads, nullptr),
        mesh(soup.view(), scheduler),
        topology(mesh, quality, scheduler, memory, progress, 1, Frame(), isa) {}
};

bool same(const Topology& a, const TopologyNode& of_a, const Topology& b,
          const TopologyNode& of_b) {
  if (!(of_a.box == of_b.box) || of_a.first != of_b.first || of_a.count != of_b.count ||
      of_a.is_leaf != of_b.is_leaf) {
    return false;
  }
  if (!of_a.is_leaf) {
    return same(a, a.child(of_a, 0), b, b.child(of_b, 0)) &&
           same(a, a.child(of_a, 1), b, b.child(of_b, 1));
  }
  const References in_a = a.references().part(of_a.first, of_a.count);
  const References in_b = b.references().part(of_b.first, of_b.count);
  return std::equal(in_a.primitives.begin(), in_a.primitives.end(), in_b.primitives.begin()) &&
         std::equal(in_a.cuts.begin(), in_a.cuts.end(), in_b.cuts.begin(), in_b.cuts.end());
}

bool holds(const Box& outer, const Box& inner) {
  for (int k = 0; k < 3; ++k) {
    if (!(outer.lower[k] <= inner.lower[k] && inner.upper[k] <= outer.upper[k])) return false;
  }
  return true;
}

// The state of a walk down a tree.
struct Walk {
  std::vector<uint32_t> met;  // how often each reference was met
  uint32_t next_pair = 0;     // pairs come depth first
};

// Checks counts, boxes and the order of pairs.
void check(const Topology& topology, const TopologyNode& node, const std::vector<Box>& boxes,
           Walk& walk) {
  if (node.is_leaf) {
    ASSERT_GE(node.count, 1u);
    ASSERT_LE(node.count, kMaxLeafReferences);
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      ++walk.met.at(i);
      ASSERT_TRUE(holds(node.box, boxes[i]));
      const auto primitives = topology.references().primitives;
      if (i > node.first) {
        ASSERT_LT(primitives[i - 1], primitives[i]);
      }
    }
    return;
  }
  ASSERT_EQ(node.first, walk.next_pair++);
  ASSERT_EQ(node.count, topology.child(node, 0).count + topology.child(node, 1).count);
  for (int side = 0; side < 2; ++side) {
    ASSERT_TRUE(holds(node.box, topology.child(node, side).box));
    check(topology, topology.child(node, side), boxes, walk);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// The boxes of all references, of parts or of whole triangles. The boxes of references that are in
// no leaf mean nothing.
std::vector<Box> boxes_of(const Tree& tree) {
  const References references = tree.topology.references();
  std::vector<Box> boxes;
  for (size_t i = 0; i < references.primitives.size(); ++i) {
    const bool in_leaf = references.primitives[i] < tree.mesh.triangle_count();
    boxes.push_back(references.is_cut(i) || !in_leaf
                        ? references.cuts[i]
                        : Corners(tree.mesh, references.primitives[i]).box());
  }
  return boxes;
}

TEST(Topology, HoldsEveryPointOfEveryTriangle) {
  for (const Soup& soup : {random_soup(1, 3000),
                           random_soup(2, 400, 1.5),
                           sliver_soup(3, 1000),
                           needle_soup(21, 3000),
                           degenerate_soup(4, 500),
                           random_soup(5, 1),
                           random_soup(5, 2),
                           random_soup(5, 7),
                           random_soup(5, 10),
                           identical_soup(100),
                           random_soup(9, 20'000),
                           sliver_soup(16, 9'000),
                           flat_soup(17, 2'000),
                           placed(random_soup(2, 400, 1.5), 0x1p50, 1e3),
                           shrinking_soup(22, 5'000, -60),
                           shrinking_soup(23, 20'000, -40),
                           shrinking_soup(24, 3'000, -140),
                           clustered_soup(25, 30'000),
                           identical_soup(20'000),
                           placed(random_soup(2, 400, 1.5), 1, 1e-30)}) {
    for (const sobb_quality quality : kQualities) {
      SCOPED_TRACE(soup.name + " quality " + std::to_string(quality));
      const Tree tree(soup, quality, 1);
      const auto primitives = tree.topology.references().primitives;
      const std::vector<Box> all = boxes_of(tree);
      Walk walk{std::vector<uint32_t>(primitives.size())};
      check(tree.topology, tree.topology.root(), all, walk);
      if (HasFatalFailure()) return;
      EXPECT_EQ(walk.next_pair, tree.topology.pairs().size());
      EXPECT_EQ(std::count(walk.met.begin(), walk.met.end(), 1u), tree.topology.root().count);
      std::vector<std::vector<Box>> boxes(tree.mesh.triangle_count());
      for (size_t i = 0; i < all.size(); ++i) {
        if (walk.met[i] == 1) boxes.at(primitives[i]).push_back(all[i]);
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

TEST(Topology, SpatialSplitsCutLongTriangles) {
  const Tree medium(needle_soup(6, 500), SOBB_QUALITY_MEDIUM, 1);
  const Tree high(needle_soup(6, 500), SOBB_QUALITY_HIGH, 1);
  EXPECT_EQ(medium.topology.root().count, 510u);
  EXPECT_GT(high.topology.root().count, 510u);
}

// Nothing overlaps, so the references that splits add would save nothing.
TEST(Topology, SpatialSplitsStayAwayWhereTheyGainNothing) {
  const Tree high(random_soup(20, 5000, 1e-3), SOBB_QUALITY_HIGH, 1);
  EXPECT_EQ(high.topology.root().count, 5000u);
}

// The references that spatial splits add have room for a quarter of the triangles.
TEST(Topology, SpatialSplitsKeepTheirRoom) {
  for (const Soup& soup : {needle_soup(11, 2000), needle_soup(12, 5000)}) {
    const Tree high(soup, SOBB_QUALITY_HIGH, 1);
    const auto count = static_cast<double>(high.mesh.triangle_count());
    EXPECT_GT(high.topology.root().count, count);
    EXPECT_LE(high.topology.root().count, 1.25 * count);
    EXPECT_EQ(high.topology.references().primitives.size(), high.topology.references().cuts.size());
  }
}

// The sum of area times cost over inner nodes and leaves' blocks.
double surface_area_cost(const Topology& topology, const TopologyNode& node) {
  if (node.is_leaf) return node.box.half_area() * ((node.count + 3) / 4);
  return node.box.half_area() + surface_area_cost(topology, topology.child(node, 0)) +
         surface_area_cost(topology, topology.child(node, 1));
}

uint32_t depth_below(const Topology& topology, const TopologyNode& node) {
  if (node.is_leaf) return 1;
  return 1 + std::max(depth_below(topology, topology.child(node, 0)),
                      depth_below(topology, topology.child(node, 1)));
}

TEST(Topology, SpatialSplitsMakeLongNeedlesCheaper) {
  const Soup soup = random_soup(13, 3000, 1.5);
  const Tree medium(soup, SOBB_QUALITY_MEDIUM, 1);
  const Tree high(soup, SOBB_QUALITY_HIGH, 1);
  EXPECT_LT(surface_area_cost(high.topology, high.topology.root()),
            surface_area_cost(medium.topology, medium.topology.root()));
}

// A shell of few large triangles lies around many small ones. The centres of the shell lie all
// around the core, but the core becomes a node of its own.
TEST(Topology, LargeTrianglesAreToldFromSmallOnes) {
  Soup soup = random_soup(14, 5000);
  const Soup shell = placed(random_soup(15, 20, 1.5), 1000, -500);
  for (uint64_t i = 0; i < 20; ++i) {
    soup.add(shell.corner(i, 0), shell.corner(i, 1), shell.corner(i, 2));
  }
  const Tree tree(soup, SOBB_QUALITY_MEDIUM, 1);
  const TopologyNode* node = &tree.topology.root();
  while (node->count > 5000) {
    const TopologyNode& left = tree.topology.child(*node, 0);
    const TopologyNode& right = tree.topology.child(*node, 1);
    node = left.count > right.count ? &left : &right;
  }
  EXPECT_EQ(node->count, 5000u);
}

// Ever smaller triangles about one point make a row of nodes, which no depth of the file holds
// unless the builder halves them at last.
TEST(Topology, KeepsToTheFilesDepth) {
  for (const double least_exponent : {-20.0, -60.0, -120.0}) {
    for (const uint32_t triangles : {50U, 5'000U, 40'000U}) {
      for (const sobb_quality quality : kQualities) {
        const Soup soup = shrinking_soup(27, triangles, least_exponent);
        const Tree tree(soup, quality, 2);
        EXPECT_LE(depth_below(tree.topology, tree.topology.root()), kMaxDepth)
            << soup.name << ", " << triangles << " triangles, quality " << quality;
      }
    }
  }
}

TEST(Topology, IsTheSameForAnyInstructionSet) {
  for (const Soup& soup : {random_soup(18, 20'000, 0.3), needle_soup(19, 6'000)}) {
    for (const sobb_quality quality : kQualities) {
      const Tree expected(soup, quality, 1);
      for (const sobb_isa isa : supported_isas()) {
        const Tree tree(soup, quality, 1, isa);
        EXPECT_TRUE(
            same(expected.topology, expected.topology.root(), tree.topology, tree.topology.root()))
            << soup.name << " quality " << quality << ", " << sobb_isa_title(isa);
      }
    }
  }
}

TEST(Topology, IsTheSameForAnyThreadCount) {
  const MoreThreads more(8);
  for (const Soup& soup : {random_soup(7, 30'000, 0.3), needle_soup(8, 6'000),
                           identical_soup(10'000), clustered_soup(26, 30'000)}) {
    for (const sobb_quality quality : kQualities) {
      const Tree one(soup, quality, 1);
      for (const uint32_t threads : {2, 3, 8}) {
        const Tree other(soup, quality, threads);
        EXPECT_TRUE(same(one.topology, one.topology.root(), other.topology, other.topology.root()))
            << soup.name << " quality " << quality << " threads " << threads;
      }
    }
  }
}

}  // namespace
}  // namespace sobb::test
