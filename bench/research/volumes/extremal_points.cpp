// SPDX-License-Identifier: Apache-2.0
#include "volumes/extremal_points.h"

#include <cmath>

namespace sobb::study {
namespace {

// Lengths do not matter: products are compared along one normal only.
constexpr float kNormal[ExtremalPoints::kNormals][3] = {
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};

}  // namespace

void ExtremalPoints::fit(const Tables&, const RelativePoint* points, uint64_t count) {
  for (int k = 0; k < kNormals; ++k) {
    along[k][0] = INFINITY;
    along[k][1] = -INFINITY;
    for (uint64_t i = 0; i < count; ++i) {
      const RelativePoint& p = points[i];
      const float product = kNormal[k][0] * p.x + kNormal[k][1] * p.y + kNormal[k][2] * p.z;
      if (product < along[k][0]) {
        along[k][0] = product;
        point[k][0] = p;
      }
      if (product > along[k][1]) {
        along[k][1] = product;
        point[k][1] = p;
      }
    }
  }
}

void ExtremalPoints::merge(const ExtremalPoints& other) {
  for (int k = 0; k < kNormals; ++k) {
    if (other.along[k][0] < along[k][0]) {
      along[k][0] = other.along[k][0];
      point[k][0] = other.point[k][0];
    }
    if (other.along[k][1] > along[k][1]) {
      along[k][1] = other.along[k][1];
      point[k][1] = other.point[k][1];
    }
  }
}

}  // namespace sobb::study
