// SPDX-License-Identifier: Apache-2.0
// See measure.h.
#include "scene/model/measure.h"

#include <algorithm>
#include <limits>

namespace sobb {
namespace {

constexpr size_t kIndicesAtOnce = 3 << 18;  // progress is reported between them

// Twice the triangle's area is |(b - a) x (c - a)|. Only the edges are rounded: products of floats
// are exact in double.
bool has_area(const float* a, const float* b, const float* c) {
  double e[3];
  double f[3];
  for (int k = 0; k < 3; ++k) {
    e[k] = double(b[k]) - double(a[k]);
    f[k] = double(c[k]) - double(a[k]);
  }
  return e[1] * f[2] != e[2] * f[1] || e[2] * f[0] != e[0] * f[2] || e[0] * f[1] != e[1] * f[0];
}

}  // namespace

void measure(Scene& scene, Progress* progress, double progress_begin) {
  scene.degenerate_count = 0;
  scene.bounds_min.fill(std::numeric_limits<float>::infinity());
  scene.bounds_max.fill(-std::numeric_limits<float>::infinity());
  const size_t size = scene.indices.size();
  for (size_t i = 0; i < size; i += 3) {
    if (progress != nullptr && i % kIndicesAtOnce == 0) {
      progress->check(progress_begin, 1, double(i) / double(size));
    }
    const float* corners[3];
    for (int c = 0; c < 3; ++c) {
      corners[c] = &scene.vertices[size_t(3) * scene.indices[i + c]];
      for (int k = 0; k < 3; ++k) {
        scene.bounds_min[k] = std::min(scene.bounds_min[k], corners[c][k]);
        scene.bounds_max[k] = std::max(scene.bounds_max[k], corners[c][k]);
      }
    }
    scene.degenerate_count += has_area(corners[0], corners[1], corners[2]) ? 0 : 1;
  }
}

Vec3 box_centre(const Scene& scene) {
  return 0.5 * (widen(scene.bounds_min.data()) + widen(scene.bounds_max.data()));
}

double half_diagonal(const Scene& scene) {
  return length(0.5 * (widen(scene.bounds_max.data()) - widen(scene.bounds_min.data())));
}

}  // namespace sobb
