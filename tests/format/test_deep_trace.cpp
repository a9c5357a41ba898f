// SPDX-License-Identifier: Apache-2.0
// The deepest files that open fill no traversal's stack beyond its end. Every node of theirs leaves
// all but one of its children on the stack.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "format/layout.h"
#include "format/small_file.h"
#include "sobb/sobb.h"
#include "support/soups.h"
#include "support/supported_isas.h"

namespace sobb {
namespace {

// Rays of one octant through points of the comb's triangle, so that they meet all nodes.
std::vector<sobb_ray> rays_through(const TriangleBlock& block, uint32_t count, uint64_t seed) {
  test::Random random(seed);
  std::vector<sobb_ray> rays(count);
  for (sobb_ray& ray : rays) {
    const double u = random.between(0.1, 0.4);
    const double v = random.between(0.1, 0.4);
    for (int k = 0; k < 3; ++k) {
      ray.direction[k] = random.between(0.5, 1);
      ray.origin[k] =
          static_cast<float>((1 - u - v) * block.vertex[0][k][0] + u * block.vertex[1][k][0] +
                             v * block.vertex[2][k][0] - ray.direction[k]);
    }
    ray.tmin = 0;
    ray.tmax = INFINITY;
  }
  return rays;
}

TEST(FormatDepth, DeepestFilesAreTracedAlike) {
  const uint64_t seed = 61;
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const uint32_t width : {4U, 8U}) {
    for (const uint32_t turn : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, kMaxDepth}) {
      const test::SmallFile file = test::make_comb(width, kMaxDepth, turn);
      sobb_hierarchy* hierarchy = nullptr;
      const auto bytes = std::as_const(file.image).bytes();
      ASSERT_EQ(sobb_open_memory(bytes.data(), bytes.size(), nullptr, &hierarchy), SOBB_OK)
          << sobb_last_error();
      for (const uint32_t count : {256U, 2048U}) {
        const auto rays = rays_through(file.parts.blocks[0], count, seed);
        std::vector<sobb_hit> expected(count);
        uint32_t hit_count = 0;
        for (uint32_t i = 0; i < count; ++i) {
          ASSERT_EQ(sobb_intersect1(hierarchy, &rays[i], &expected[i]), SOBB_OK);
          hit_count += expected[i].primitive == 0 ? 1 : 0;
        }
        EXPECT_GE(hit_count, count * 9 / 10);
        for (const sobb_isa isa : test::supported_isas()) {
          for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
            SCOPED_TRACE(std::to_string(width) + " wide, turn " + std::to_string(turn) + ", isa " +
                         std::to_string(isa) + ", flags " + std::to_string(flags));
            sobb_trace_options options = {};
            options.struct_size = sizeof options;
            options.threads = 1;
            options.isa = isa;
            options.flags = flags;
            std::vector<sobb_hit> hits(count);
            ASSERT_EQ(sobb_intersect(hierarchy, rays.data(), count, hits.data(), &options),
                      SOBB_OK);
            ASSERT_EQ(std::memcmp(hits.data(), expected.data(), count * sizeof hits[0]), 0);
            std::vector<uint8_t> occluded(count);
            ASSERT_EQ(sobb_occluded(hierarchy, rays.data(), count, occluded.data(), &options),
                      SOBB_OK);
            for (uint32_t i = 0; i < count; ++i) {
              ASSERT_EQ(occluded[i] == SOBB_OCCLUDED, expected[i].primitive != SOBB_MISS) << i;
            }
          }
        }
      }
      sobb_release(hierarchy);
    }
  }
}

}  // namespace
}  // namespace sobb
