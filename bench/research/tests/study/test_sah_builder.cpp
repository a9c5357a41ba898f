// SPDX-License-Identifier: Apache-2.0
// The study's builder keeps every triangle, whatever it splits by.
#include "study/binary/sah_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/memory.h"
#include "study/binary/fibre_split.h"
#include "support/soups.h"

namespace sobb::study {
namespace {

void expect_whole(const BinaryTree& tree, uint64_t triangles, uint32_t leaf_limit) {
  std::vector<bool> met(triangles);
  uint32_t next = 0;
  for (const BinaryNode& node : tree.nodes) {
    if (!node.is_leaf()) {
      EXPECT_EQ(node.count, tree.nodes[node.child[0]].count + tree.nodes[node.child[1]].count);
      continue;
    }
    EXPECT_LE(node.count, leaf_limit);
    EXPECT_EQ(node.first, next);
    next += node.count;
    for (uint32_t i = 0; i < node.count; ++i) {
      met[tree.references[node.first + i].primitive] = true;
    }
  }
  EXPECT_EQ(next, triangles);
  EXPECT_EQ(std::count(met.begin(), met.end(), true), static_cast<std::ptrdiff_t>(triangles));
}

TEST(SahBuilder, KeepsEveryTriangle) {
  const Scheduler scheduler(1, nullptr);
  for (const test::Soup& soup :
       {test::random_soup(3, 300), test::sliver_soup(4, 200), test::degenerate_soup(5, 200),
        test::identical_soup(100), test::placed(test::random_soup(6, 100), 0x1p50, 1e3)}) {
    SCOPED_TRACE(soup.name);
    Memory memory;
    const Mesh mesh(soup.view(), scheduler);
    const AreaMeasure measure(mesh, summarise(mesh, scheduler, memory), memory);
    const auto tangents = fibre_tangents(mesh);
    const SahSettings all[] = {{SOBB_VOLUME_AABB, 3, false, 8},
                               {SOBB_VOLUME_SOBB, 32, false, 8},
                               {SOBB_VOLUME_SOBB, 3, true, 8},
                               {SOBB_VOLUME_SOBB, 32, true, 1}};
    for (const SahSettings& settings : all) {
      BinaryTree tree;
      for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        tree.references.push_back({i});
      }
      SahBuilder(measure, tangents, settings).build(tree);
      expect_whole(tree, mesh.triangle_count(), settings.leaf_limit);
      const SahBuilder finest(measure, tangents, {SOBB_VOLUME_SOBB, 3, false, 1});
      expect_whole(finest.split_leaves(tree), mesh.triangle_count(), 1);
    }
  }
}

// Strands along two axes, mixed in space.
TEST(FibreSplit, ClustersByOrientation) {
  std::vector<Vector> tangents;
  std::vector<Reference> references;
  for (uint32_t i = 0; i < 20; ++i) {
    const double tilt = 0.01 * i;
    tangents.push_back(i % 2 == 0 ? Vector{1, tilt, 0} : Vector{0, tilt, -1});
    references.push_back({i});
  }
  const auto split = split_fibres(references, tangents);
  ASSERT_TRUE(split.has_value());
  for (uint32_t i = 2; i < 20; ++i) {
    EXPECT_EQ(split->is_second(tangents[i]), split->is_second(tangents[i % 2])) << i;
  }
  EXPECT_NE(split->is_second(tangents[0]), split->is_second(tangents[1]));
  EXPECT_FALSE(split_fibres(std::span(references).first(1), tangents).has_value());
}

}  // namespace
}  // namespace sobb::study
