// SPDX-License-Identifier: Apache-2.0
// Rays from inside of a closed surface never escape.
#include <gtest/gtest.h>

#include "capi/handles.h"
#include "capi/random_bases.h"
#include "support/closed_meshes.h"
#include "support/sanitized.h"

namespace sobb::test {
namespace {

void expect_all_hit(const HierarchyHandle& hierarchy, const std::vector<sobb_ray>& rays,
                    const std::string& what) {
  for (const uint32_t flags : {0U, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
    const std::vector<sobb_hit> hits = trace(hierarchy, rays, trace_options(flags));
    for (size_t i = 0; i < hits.size(); ++i) {
      ASSERT_NE(hits[i].primitive, SOBB_MISS) << what << " ray " << i;
    }
  }
}

TEST(Watertight, RaysFromInsideNeverEscape) {
  constexpr uint64_t kSeed = 31;
  constexpr uint32_t kRays = kSanitized ? 2'000 : 10'000;
  for (const ClosedMesh& mesh : closed_meshes()) {
    const std::vector<sobb_ray> rays = rays_from_inside(mesh, kSeed, kRays);
    for (const uint32_t volume : {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB}) {
      for (const uint32_t quality : {SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
        const std::string what = mesh.soup.name + " seed " + std::to_string(kSeed) + " volume " +
                                 std::to_string(volume) + " quality " + std::to_string(quality);
        const HierarchyHandle hierarchy = build_soup(mesh.soup, build_options(volume, quality));
        expect_all_hit(hierarchy, rays, what);
        if (volume == SOBB_VOLUME_AABB) continue;
        expect_all_hit(with_random_bases(hierarchy, kSeed), rays, what + " random bases");
      }
    }
  }
}

}  // namespace
}  // namespace sobb::test
