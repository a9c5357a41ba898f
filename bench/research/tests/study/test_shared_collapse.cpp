// SPDX-License-Identifier: Apache-2.0
// The collapse that knows the shared basis makes nodes and leaves that a file can hold.
#include "study/wide/shared_collapse.h"

#include <gtest/gtest.h>

#include "base/memory.h"
#include "format/layout.h"
#include "study/binary/sah_builder.h"
#include "study/wide/wide_layout.h"
#include "support/soups.h"

namespace sobb::study {
namespace {

TEST(SharedCollapse, KeepsEveryTriangleAndTheLimits) {
  const Scheduler scheduler(1, nullptr);
  const std::vector<Vector> no_fibres;
  for (const test::Soup& soup : {test::random_soup(1, 400), test::sliver_soup(2, 300),
                                 test::degenerate_soup(3, 200), test::identical_soup(100)}) {
    SCOPED_TRACE(soup.name);
    Memory memory;
    const Mesh mesh(soup.view(), scheduler);
    const AreaMeasure measure(mesh, summarise(mesh, scheduler, memory), memory);
    BinaryTree tree;
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
      tree.references.push_back({i});
    }
    SahBuilder(measure, no_fibres, {SOBB_VOLUME_SOBB, 3, false, 1}).build(tree);
    for (const Leaves leaves : {Leaves::kKept, Leaves::kChosen}) {
      const WideCut cut = collapse_sharing(tree, measure, leaves);
      const WideLayout layout = lay_out(tree, cut, memory);
      uint64_t triangles = 0;
      for (const WideNode& node : layout.topology.top.nodes) {
        EXPECT_GE(node.child_count, 2U);
        EXPECT_LE(node.child_count, kMaxWidth);
        for (uint32_t i = 0; i < node.child_count; ++i) {
          if (!node.is_leaf(i)) continue;
          EXPECT_LE(node.count[i], leaves == Leaves::kKept ? 1 : 8);
          triangles += node.count[i];
        }
      }
      EXPECT_EQ(triangles, mesh.triangle_count());
    }
  }
}

}  // namespace
}  // namespace sobb::study
