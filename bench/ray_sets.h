// SPDX-License-Identifier: Apache-2.0
// The rays that every method traces. They depend on the scene, the view and the size only: closest
// hits are the same bits from every version of the library, so the rays are, too.
#pragma once

#include <cstdint>
#include <vector>

#include "row.h"
#include "sobb/scene.h"
#include "sobb/sobb.h"
#include "vec3.h"

namespace sobb::bench {

struct RaySet {
  RayKind kind;
  std::vector<sobb_ray> rays;

  bool any_hit() const { return kind == RayKind::kShadow; }
  bool coherent() const { return kind == RayKind::kPrimary; }
};

/// A point that a primary ray hit, moved off its triangle to the ray's side.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  // the triangle's, unit, on the ray's side
};

struct Surface {
  std::vector<SurfacePoint> points;  // in the order of the rays that hit
  double median_distance = 0;        // from the eye
};

/// Rays of unit direction through the pixels' centres of a square image, size x size, in tiles of
/// 8x8 pixels in row order, the pixels of a tile in Morton order, so that 16 (8) neighbours in the
/// array are a square of 4x4 (4x2) pixels.
RaySet primary_rays(const sobb_view& view, uint32_t size);

/// Where the primary rays met the scene. Points stand off their triangle by 2^-17 of the largest
/// coordinate: some hundred units in the last place, so that rays from them start free.
Surface surface_of(const sobb_triangles& triangles, const sobb_scene_info& scene,
                   const RaySet& primary, const std::vector<sobb_hit>& hits);

/// To a point light that hangs half the median hit distance to the right of the eye and as much
/// above it; from the points whose side faces it. t is 0 at the point and 1 at the light.
RaySet shadow_rays(const sobb_view& view, const Surface& surface);

/// One a point, distributed by the cosine to the normal, in the pixels' order as a path tracer
/// makes them.
RaySet diffuse_rays(const Surface& surface);

/// Origins uniform in the scene's box, directions uniform over the sphere.
RaySet random_rays(const sobb_scene_info& scene, size_t count);

}  // namespace sobb::bench
