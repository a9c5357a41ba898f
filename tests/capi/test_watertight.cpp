// SPDX-License-Identifier: Apache-2.0
// Rays from inside of a closed surface never escape.
#include <gtest/gtest.h>

#include "capi/handles.h"
#include "support/closed_meshes.h"

namespace sobb::test {
namespace {

constexpr uint32_t kVolumes[] = {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB};

TEST(Watertight, RaysFromInsideNeverEscape) {
  constexpr uint64_t kSeed = 31;
  for (const ClosedMesh& mesh : closed_meshes()) {
    const std::vector<sobb_ray> rays = rays_from_inside(mesh, kSeed, 10'000);
    for (const uint32_t volume : kVolumes) {
      for (const uint32_t quality : {SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
        const HierarchyHandle hierarchy = build_soup(mesh.soup, build_options(volume, quality));
        for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
          const std::vector<sobb_hit> hits = trace(hierarchy, rays, trace_options(flags));
          for (size_t i = 0; i < hits.size(); ++i) {
            ASSERT_NE(hits[i].primitive, SOBB_MISS)
                << mesh.soup.name << " seed " << kSeed << " ray " << i << " volume " << volume;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace sobb::test
