// SPDX-License-Identifier: Apache-2.0
// What waves are made of, and what no built hierarchy makes them meet. That they find the hits of
// rays one by one is test_arrays.cpp's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "format/layout.h"
#include "support/scratch.h"
#include "support/supported_isas.h"
#include "trace/trace.h"
#include "trace/wave/push_table.h"

namespace sobb::test {
namespace {

TEST(PushTable, KeepsLanesInOrder) {
  for (uint32_t mask = 0; mask < 16; ++mask) {
    uint32_t kept = 0;
    for (uint8_t lane = 0; lane < 4; ++lane) {
      if ((mask >> lane & 1) == 0) continue;
      EXPECT_EQ(kPushTable.lanes<4>(mask)[kept++], lane) << mask;
    }
  }
  // The lower halves of the blocks of four, then the upper ones.
  constexpr int kOrder[8] = {0, 1, 4, 5, 2, 3, 6, 7};
  for (uint32_t mask = 0; mask < 256; ++mask) {
    uint32_t kept = 0;
    for (uint8_t lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1) == 0) continue;
      EXPECT_EQ(kPushTable.lanes<8>(mask)[kOrder[kept++]], lane) << mask;
    }
  }
}

// A leaf as large as a file may have, whose key the end of a stack shares a mark with: layers of
// triangles under the origin, the nearest one last.
TEST(Wave, VisitsTheLargestLeaf) {
  constexpr uint32_t kTriangles = kTriangleMask;
  FileHeader header = {};
  header.volume = SOBB_VOLUME_AABB;
  header.width = 8;
  header.radius = 200;
  const Direction axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Node<8> node = {};
  const float box[3][2] = {{-1, 1}, {-1, 1}, {-100, 0}};
  for (int j = 0; j < 3; ++j) {
    for (int side = 0; side < 2; ++side) node.slab[j][side][0] = box[j][side];
  }
  node.basis[0] = kAxesBasis;
  node.meta[0] = kLeafBit | kSharedBit | 1U << kChildCountShift | kTriangles;
  std::vector<TriangleBlock> blocks(blocks_of(kTriangles));
  for (TriangleBlock& block : blocks) std::fill_n(block.primitive, 4, kNoPrimitive);
  for (uint32_t i = 0; i < kTriangles; ++i) {
    TriangleBlock& block = blocks[i / 4];
    const float corner[3][2] = {{-1, -1}, {1, -1}, {0, 1}};
    for (int v = 0; v < 3; ++v) {
      for (int k = 0; k < 2; ++k) block.vertex[v][k][i % 4] = corner[v][k];
      block.vertex[v][2][i % 4] = -100 + static_cast<float>(i);
    }
    block.primitive[i % 4] = i;
  }
  FileView view;
  view.header = &header;
  view.directions = axes;
  view.nodes = &node;
  view.node_count = 1;
  view.blocks = blocks;
  const Tracer tracer(view);

  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const sobb_ray down = {{0, 0, 5}, 0, {0, 0, -1}, kInfinity};
  const sobb_ray beside = {{0, 0, 5}, 0, {1, 0, -1}, kInfinity};
  std::vector<sobb_ray> rays(101, down);
  for (size_t i = 0; i < rays.size(); i += 3) rays[i] = beside;
  for (const sobb_isa isa : supported_isas()) {
    const TraceKernels& kernels = trace_kernels(isa);
    std::vector<sobb_hit> hits(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    const Scratch scratch(kernels.scratch_bytes);
    EXPECT_EQ(kernels.intersect_array[kWaveMode](tracer, rays.data(), rays.size(), hits.data(),
                                                 scratch.get()),
              0U);
    EXPECT_EQ(kernels.occluded_array[kWaveMode](tracer, rays.data(), rays.size(), occluded.data(),
                                                scratch.get()),
              0U);
    for (size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(hits[i].primitive, i % 3 == 0 ? SOBB_MISS : kTriangles - 1) << i;
      EXPECT_EQ(occluded[i], i % 3 == 0 ? SOBB_FREE : SOBB_OCCLUDED) << i;
    }
  }
}

}  // namespace
}  // namespace sobb::test
