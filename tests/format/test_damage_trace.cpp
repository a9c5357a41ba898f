// SPDX-License-Identifier: Apache-2.0
// Damaged files that open all the same, since their checksums are recomputed, are safe to trace.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "format/small_file.h"
#include "sobb/sobb.h"
#include "support/supported_isas.h"

namespace sobb {
namespace {

// Rays toward the triangles from all sides, and from within.
std::vector<sobb_ray> rays_about(const float (&centre)[3]) {
  std::vector<sobb_ray> rays;
  for (int i = 0; i < 256; ++i) {  // enough for a batch
    const float angle = 0.7f * static_cast<float>(i);
    const float direction[3] = {std::cos(angle), std::sin(angle), std::cos(2.3f * angle)};
    const float distance = i % 4 == 0 ? 0.0f : 5.0f;
    sobb_ray ray = {{}, 0, {}, INFINITY};
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = centre[axis] - distance * direction[axis];
      ray.direction[axis] = direction[axis];
    }
    rays.push_back(ray);
  }
  return rays;
}

// Traces the file, if it opens, in each way that has a kernel of its own. Returns whether it did.
bool trace(std::span<const std::byte> bytes, const std::vector<sobb_ray>& rays) {
  sobb_open_options open = {};
  open.struct_size = sizeof open;
  open.threads = 1;
  sobb_hierarchy* hierarchy = nullptr;
  if (sobb_open_memory(bytes.data(), bytes.size(), &open, &hierarchy) != SOBB_OK) return false;
  std::vector<sobb_hit> hits(rays.size());
  std::vector<uint8_t> occluded(rays.size());
  for (const sobb_isa isa : test::supported_isas()) {
    for (const uint32_t flags : {0, static_cast<int>(SOBB_TRACE_COHERENT)}) {
      sobb_trace_options options = {};
      options.struct_size = sizeof options;
      options.threads = 1;
      options.isa = isa;
      options.flags = flags;
      EXPECT_EQ(sobb_intersect(hierarchy, rays.data(), rays.size(), hits.data(), &options), SOBB_OK)
          << sobb_last_error();
      EXPECT_EQ(sobb_occluded(hierarchy, rays.data(), rays.size(), occluded.data(), &options),
                SOBB_OK)
          << sobb_last_error();
    }
  }
  sobb_release(hierarchy);
  return true;
}

TEST(FormatDamage, WhatOpensIsSafeToTrace) {
  for (const sobb_volume volume : {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB}) {
    for (const uint32_t width : {4u, 8u}) {
      test::SmallFile file = test::make_small_file(volume, width);
      const auto rays = rays_about(file.header().centre);
      ASSERT_TRUE(trace(file.bytes(), rays)) << sobb_last_error();
      for (size_t at = 0; at < file.bytes().size(); ++at) {
        for (const int change : {0x01, 0xC0}) {
          Image damaged = test::copy_of(file.bytes());
          damaged.bytes()[at] ^= static_cast<std::byte>(change);
          test::reseal(damaged.bytes());
          trace(damaged.bytes(), rays);
        }
      }
    }
  }
}

}  // namespace
}  // namespace sobb
