// SPDX-License-Identifier: Apache-2.0
// The rays that every method traces. They depend on the scene, the view and the size only: every
// version of the library finds the same bits as closest hits, so the rays are the same, too.
#pragma once

#include <cstdint>
#include <functional>
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

/// A point that a ray hit, moved off its triangle to the ray's side.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  // the triangle's, unit, on the ray's side
};

struct Surface {
  std::vector<SurfacePoint> points;  // in the order of the rays that hit
  double median_distance = 0;        // from the eye, where the rays are primary
};

/// Rays of unit direction through the pixels' centres of a square image, size x size, in tiles of
/// 8x8 pixels in row order, the pixels of a tile in Morton order, so that 16 (8) neighbours in the
/// array are a square of 4x4 (4x2) pixels.
RaySet primary_rays(const sobb_view& view, uint32_t size);

/// The points where rays met the scene. They stand off their triangle by 2^-17 of the largest
/// coordinate: some hundred units in the last place, so that rays from them start free.
Surface surface_of(const sobb_triangles& triangles, const sobb_scene_info& scene, const RaySet& set,
                   const std::vector<sobb_hit>& hits);

/// Rays from the points whose side faces it to a point light, which hangs half the median hit
/// distance to the right of the eye and as much above it. t is 0 at the point and 1 at the light.
RaySet shadow_rays(const sobb_view& view, const Surface& surface);

/// One ray per point, distributed by the cosine to the normal, in the pixels' order as a path
/// tracer makes them. Each bounce, counted from 1, has random numbers of its own.
RaySet diffuse_rays(const Surface& surface, uint32_t bounce = 1);

using ClosestHits = std::function<std::vector<sobb_hit>(const RaySet&)>;

/// All bounces 1 to @p bounces of a path tracer, one after another: one path per primary ray, each
/// bounce diffuse, without Russian roulette; a path ends where it leaves the scene.
RaySet path_rays(const sobb_triangles& triangles, const sobb_scene_info& scene, RaySet primary,
                 uint32_t bounces, const ClosestHits& closest_hits);

/// Rays with origins uniform in the scene's box and directions uniform over the sphere.
RaySet random_rays(const sobb_scene_info& scene, size_t count);

}  // namespace sobb::bench
