// SPDX-License-Identifier: Apache-2.0
#include "trace/oracle.h"

#include <atomic>

#include "trace/ray/validity.h"
#include "trace/triangles/closest_hit.h"
#include "trace/triangles/triangle_test.h"

namespace sobb {
namespace {

sobb_hit brute_force_ray(const Mesh& mesh, const sobb_ray& ray) {
  const TriangleRay triangle_ray(ray);
  ClosestHit best(ray);
  for (uint64_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    float vertex[3][3];  // [axis][corner]
    for (int i = 0; i < 3; ++i) {
      const Point point = mesh.corner(triangle, i);
      vertex[0][i] = point.x;
      vertex[1][i] = point.y;
      vertex[2][i] = point.z;
    }
    TriangleHit hit;
    if (intersect_triangle(triangle_ray, vertex[triangle_ray.axis[0]], vertex[triangle_ray.axis[1]],
                           vertex[triangle_ray.axis[2]], hit)) {
      best.offer(hit, ray.tmin, static_cast<uint32_t>(triangle));
    }
  }
  return best.result();
}

}  // namespace

uint64_t brute_force(const Mesh& mesh, const sobb_ray* rays, uint64_t count, sobb_hit* hits,
                     const Scheduler& scheduler) {
  std::atomic<uint64_t> invalid{0};
  scheduler.for_each(count, [&](uint64_t i) {
    if (is_valid(rays[i])) {
      hits[i] = brute_force_ray(mesh, rays[i]);
    } else {
      hits[i] = ClosestHit::missed(SOBB_INVALID);
      invalid.fetch_add(1, std::memory_order_relaxed);
    }
  });
  return invalid;
}

}  // namespace sobb
