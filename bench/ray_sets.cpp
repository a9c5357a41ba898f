// SPDX-License-Identifier: Apache-2.0
// The rays are made in double and without the standard library's distributions, which differ
// between implementations.
#include "ray_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace sobb::bench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// SplitMix64 (G. Steele, D. Lea, C. Flood, Fast Splittable Pseudorandom Number Generators, 2014).
// Each ray has its own sequence, so that it does not depend on the rays before it.
class Random {
 public:
  Random(uint64_t seed, uint64_t ray) : state_(mix(seed) ^ mix(ray)) {}

  /// Uniform in [0, 1).
  double unit() {
    state_ += 0x9E3779B97F4A7C15u;
    return static_cast<double>(mix(state_) >> 11) * 0x1p-53;
  }

  /// Uniform over the unit sphere, by rejection from the cube.
  Vec3 direction() {
    for (;;) {
      const Vec3 v{2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1};
      const double square = dot(v, v);
      if (square > 0x1p-20 && square <= 1) return normalized(v);
    }
  }

 private:
  static uint64_t mix(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

constexpr uint64_t kDiffuseSeed = 1;  // of the first bounce
constexpr uint64_t kRandomSeed = 2;
constexpr uint64_t kBounceStep = 256;  // from a bounce's seed to the next one's

sobb_ray make_ray(Vec3 origin, Vec3 direction, float tmax) {
  return {
      {static_cast<float>(origin.x), static_cast<float>(origin.y), static_cast<float>(origin.z)},
      0,
      {static_cast<float>(direction.x), static_cast<float>(direction.y),
       static_cast<float>(direction.z)},
      tmax};
}

// The camera's right-handed axes, all unit vectors.
struct CameraAxes {
  explicit CameraAxes(const sobb_view& view)
      : forward(normalized(load(view.target) - load(view.eye))),
        right(normalized(cross(forward, load(view.up)))),
        up(cross(right, forward)) {}

  Vec3 forward, right, up;
};

// Every second bit of a Morton code of six bits is one coordinate of the pixel in its tile.
constexpr uint32_t even_bits(uint32_t code) {
  return (code & 1) | ((code >> 1) & 2) | ((code >> 2) & 4);
}

}  // namespace

RaySet primary_rays(const sobb_view& view, uint32_t size) {
  constexpr uint32_t kTile = 8;
  const CameraAxes camera(view);
  const double half_height = std::tan(view.vfov_degrees * std::numbers::pi / 360);
  RaySet set{RayKind::kPrimary, {}};
  set.rays.reserve(size_t{size} * size);
  for (uint32_t tile_y = 0; tile_y < size; tile_y += kTile) {
    for (uint32_t tile_x = 0; tile_x < size; tile_x += kTile) {
      for (uint32_t code = 0; code < kTile * kTile; ++code) {
        const uint32_t x = tile_x + even_bits(code);
        const uint32_t y = tile_y + even_bits(code >> 1);
        if (x >= size || y >= size) continue;
        const double across = half_height * ((2 * x + 1.0) / size - 1);
        const double down = half_height * ((2 * y + 1.0) / size - 1);
        const Vec3 direction = camera.forward + across * camera.right - down * camera.up;
        set.rays.push_back(make_ray(load(view.eye), normalized(direction), kInfinity));
      }
    }
  }
  return set;
}

Surface surface_of(const sobb_triangles& triangles, const sobb_scene_info& scene, const RaySet& set,
                   const std::vector<sobb_hit>& hits) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(double{scene.bounds_min[axis]}),
                        std::abs(double{scene.bounds_max[axis]})});
  }
  const double offset = 0x1p-17 * largest;

  Surface surface;
  std::vector<float> distances;
  for (size_t i = 0; i < hits.size(); ++i) {
    const sobb_hit& hit = hits[i];
    if (hit.primitive >= triangles.triangle_count) continue;  // a miss
    Vec3 corners[3];
    for (size_t corner = 0; corner < 3; ++corner) {
      const size_t vertex = triangles.indices[3 * size_t{hit.primitive} + corner];
      corners[corner] = load(&triangles.vertices[3 * vertex]);
    }
    const Vec3 edge1 = corners[1] - corners[0];
    const Vec3 edge2 = corners[2] - corners[0];
    Vec3 normal = normalized(cross(edge1, edge2));
    if (dot(normal, load(set.rays[i].direction)) > 0) normal = -1 * normal;
    const Vec3 point = corners[0] + hit.u * edge1 + hit.v * edge2;
    surface.points.push_back({point + offset * normal, normal});
    distances.push_back(hit.t);
  }
  if (!distances.empty()) {
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    surface.median_distance = *middle;
  }
  return surface;
}

RaySet shadow_rays(const sobb_view& view, const Surface& surface) {
  const CameraAxes camera(view);
  const Vec3 light = load(view.eye) + surface.median_distance / 2 * (camera.right + camera.up);
  RaySet set{RayKind::kShadow, {}};
  for (const SurfacePoint& point : surface.points) {
    const Vec3 to_light = light - point.position;
    if (dot(to_light, point.normal) > 0) set.rays.push_back(make_ray(point.position, to_light, 1));
  }
  return set;
}

RaySet diffuse_rays(const Surface& surface, uint32_t bounce) {
  RaySet set{RayKind::kDiffuse1, {}};
  set.rays.reserve(surface.points.size());
  for (size_t i = 0; i < surface.points.size(); ++i) {
    const SurfacePoint& point = surface.points[i];
    // A uniform point of the unit sphere that touches the surface is cosine-distributed from there.
    Random random(kDiffuseSeed + (bounce - 1) * kBounceStep, i);
    Vec3 direction = point.normal + random.direction();
    if (length(direction) < 0x1p-20) direction = point.normal;
    set.rays.push_back(make_ray(point.position, normalized(direction), kInfinity));
  }
  return set;
}

RaySet path_rays(const sobb_triangles& triangles, const sobb_scene_info& scene, RaySet primary,
                 uint32_t bounces, const ClosestHits& closest_hits) {
  RaySet all{RayKind::kDiffuse7, {}};
  RaySet set = std::move(primary);
  for (uint32_t bounce = 1; bounce <= bounces; ++bounce) {
    set = diffuse_rays(surface_of(triangles, scene, set, closest_hits(set)), bounce);
    all.rays.insert(all.rays.end(), set.rays.begin(), set.rays.end());
  }
  return all;
}

RaySet random_rays(const sobb_scene_info& scene, size_t count) {
  const Vec3 low = load(scene.bounds_min);
  const Vec3 extent = load(scene.bounds_max) - low;
  RaySet set{RayKind::kRandom, {}};
  set.rays.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    Random random(kRandomSeed, i);
    const Vec3 place{random.unit() * extent.x, random.unit() * extent.y, random.unit() * extent.z};
    set.rays.push_back(make_ray(low + place, random.direction(), kInfinity));
  }
  return set;
}

}  // namespace sobb::bench
