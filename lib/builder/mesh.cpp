// SPDX-License-Identifier: Apache-2.0
#include "builder/mesh.h"

// Makes the streaming state a type of known size, which needs no allocation.
#define XXH_STATIC_LINKING_ONLY
#include "base/xxh3.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace sobb {
namespace {

constexpr uint64_t kGrain = 1 << 16;  // triangles per range; defines source_hash
constexpr float kLargest = 0x1p60F;

using llu = unsigned long long;

void check_coordinate(float value, char axis, uint32_t vertex, uint64_t triangle) {
  if (std::fabs(value) <= kLargest) return;
  if (!(std::fabs(value) <= FLT_MAX)) {
    fail(SOBB_ERROR_NOT_FINITE, "triangle %llu: %c of vertex %u is %g", static_cast<llu>(triangle),
         axis, vertex, value);
  }
  fail(SOBB_ERROR_TOO_LARGE, "triangle %llu: %c of vertex %u is %g, beyond 2^60",
       static_cast<llu>(triangle), axis, vertex, value);
}

// The summary of one range of triangles.
struct RangeSummary {
  Point lower{FLT_MAX, FLT_MAX, FLT_MAX};
  Point upper{-FLT_MAX, -FLT_MAX, -FLT_MAX};
  uint64_t degenerate_count = 0;
  uint64_t hash = 0;
};

// Returns whether a triangle has no area in exact arithmetic. Differences and products of floats in
// double err only where the exponents of the coordinates lie far apart.
bool is_degenerate(const Point corner[3]) {
  const double ax = static_cast<double>(corner[1].x) - corner[0].x;
  const double ay = static_cast<double>(corner[1].y) - corner[0].y;
  const double az = static_cast<double>(corner[1].z) - corner[0].z;
  const double bx = static_cast<double>(corner[2].x) - corner[0].x;
  const double by = static_cast<double>(corner[2].y) - corner[0].y;
  const double bz = static_cast<double>(corner[2].z) - corner[0].z;
  return ay * bz == az * by && az * bx == ax * bz && ax * by == ay * bx;
}

// A triangle as the hash reads it.
struct HashedTriangle {
  Point corner[3];
  uint32_t index[3];
};
static_assert(sizeof(HashedTriangle) == 12 * sizeof(float));
// So many triangles go to the hash at a time: a call costs more than the hash of one triangle.
constexpr uint64_t kHashedTogether = 64;

RangeSummary summarise_range(const Mesh& mesh, uint64_t begin, uint64_t end) {
  RangeSummary part;
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  for (uint64_t first = begin; first < end; first += kHashedTogether) {
    const uint64_t count = std::min(kHashedTogether, end - first);
    HashedTriangle triangles[kHashedTogether];
    for (uint64_t i = 0; i < count; ++i) {
      HashedTriangle& triangle = triangles[i];
      for (int j = 0; j < 3; ++j) {
        const Point corner = mesh.corner(first + i, j);
        triangle.corner[j] = corner;
        triangle.index[j] = mesh.index(first + i, j);
        part.lower = {std::min(part.lower.x, corner.x), std::min(part.lower.y, corner.y),
                      std::min(part.lower.z, corner.z)};
        part.upper = {std::max(part.upper.x, corner.x), std::max(part.upper.y, corner.y),
                      std::max(part.upper.z, corner.z)};
      }
      part.degenerate_count += is_degenerate(triangle.corner);
    }
    XXH3_64bits_update(&state, triangles, count * sizeof(HashedTriangle));
  }
  part.hash = XXH3_64bits_digest(&state);
  return part;
}

double squared_distance(Point a, Point b) {
  const double x = static_cast<double>(a.x) - b.x;
  const double y = static_cast<double>(a.y) - b.y;
  const double z = static_cast<double>(a.z) - b.z;
  return x * x + y * y + z * z;
}

// The middle of an interval, rounded; the sum of two floats is exact enough in double.
float middle(float a, float b) { return static_cast<float>((static_cast<double>(a) + b) / 2); }

// The square root, rounded up to a float.
float root_above(double square) {
  const float root = static_cast<float>(std::sqrt(square));
  return std::nextafter(std::nextafter(root, FLT_MAX), FLT_MAX);
}

}  // namespace

Mesh::Mesh(const sobb_triangles& triangles, const Scheduler& scheduler)
    : vertices_(reinterpret_cast<const unsigned char*>(triangles.vertices)),
      vertex_count_(triangles.vertex_count),
      stride_(triangles.vertex_stride == 0 ? sizeof(Point) : triangles.vertex_stride),
      indices_(triangles.indices),
      triangle_count_(triangles.triangle_count) {
  if (triangle_count_ == 0) fail(SOBB_ERROR_EMPTY, "the mesh has no triangle");
  if (triangle_count_ > SOBB_MAX_TRIANGLES) {
    fail(SOBB_ERROR_TOO_LARGE, "%llu triangles, more than %llu", static_cast<llu>(triangle_count_),
         llu{SOBB_MAX_TRIANGLES});
  }
  if (triangles.reserved != 0) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "triangles: reserved is %u", triangles.reserved);
  }
  if (vertices_ == nullptr) fail(SOBB_ERROR_INVALID_ARGUMENT, "triangles: vertices is NULL");
  if (indices_ == nullptr) fail(SOBB_ERROR_INVALID_ARGUMENT, "triangles: indices is NULL");
  if (stride_ < sizeof(Point) || stride_ % sizeof(float) != 0) {
    fail(SOBB_ERROR_INVALID_ARGUMENT,
         "triangles: vertex_stride is %llu, not a multiple of 4 from 12",
         static_cast<llu>(stride_));
  }
  scheduler.for_ranges(triangle_count_, kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t triangle = begin; triangle < end; ++triangle) {
      for (int i = 0; i < 3; ++i) {
        const uint32_t vertex = index(triangle, i);
        if (vertex >= vertex_count_) {
          fail(SOBB_ERROR_INDEX, "triangle %llu: vertex index %u, but there are %llu vertices",
               static_cast<llu>(triangle), vertex, static_cast<llu>(vertex_count_));
        }
        const Point point = corner(triangle, i);
        check_coordinate(point.x, 'x', vertex, triangle);
        check_coordinate(point.y, 'y', vertex, triangle);
        check_coordinate(point.z, 'z', vertex, triangle);
      }
    }
  });
}

MeshSummary summarise(const Mesh& mesh, const Scheduler& scheduler,
                      std::pmr::memory_resource& scratch) {
  const uint64_t count = mesh.triangle_count();
  std::pmr::vector<RangeSummary> parts((count + kGrain - 1) / kGrain, &scratch);
  scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
    parts[begin / kGrain] = summarise_range(mesh, begin, end);
  });
  MeshSummary summary{parts[0].lower, parts[0].upper, {}, 0, 0, 0};
  std::pmr::vector<uint64_t> hashes(&scratch);
  for (const RangeSummary& part : parts) {
    summary.lower = {std::min(summary.lower.x, part.lower.x),
                     std::min(summary.lower.y, part.lower.y),
                     std::min(summary.lower.z, part.lower.z)};
    summary.upper = {std::max(summary.upper.x, part.upper.x),
                     std::max(summary.upper.y, part.upper.y),
                     std::max(summary.upper.z, part.upper.z)};
    summary.degenerate_count += part.degenerate_count;
    hashes.push_back(part.hash);
  }
  summary.source_hash = XXH3_64bits(hashes.data(), hashes.size() * sizeof(uint64_t));
  summary.centre = {middle(summary.lower.x, summary.upper.x),
                    middle(summary.lower.y, summary.upper.y),
                    middle(summary.lower.z, summary.upper.z)};

  std::pmr::vector<double> squares(parts.size(), &scratch);
  scheduler.for_ranges(count, kGrain, [&](uint64_t begin, uint64_t end) {
    double largest = 0;
    for (uint64_t triangle = begin; triangle < end; ++triangle) {
      for (int i = 0; i < 3; ++i) {
        largest = std::max(largest, squared_distance(mesh.corner(triangle, i), summary.centre));
      }
    }
    squares[begin / kGrain] = largest;
  });
  summary.radius = root_above(*std::max_element(squares.begin(), squares.end()));
  return summary;
}

}  // namespace sobb
