// SPDX-License-Identifier: Apache-2.0
// ExtremalPoints are the points that lie furthest along the normals of a 14-DOP. The ditetrahedron
// asks for nothing else, and the extremal points of a union are among those of its parts.
#pragma once

#include <cstdint>

#include "bounds/bounds_kernels.h"
#include "volumes/tables.h"

namespace sobb::study {

struct ExtremalPoints {
  static constexpr int kNormals = 7;
  RelativePoint point[kNormals][2];  // with the least and the greatest product with each normal
  float along[kNormals][2];          // these products

  void fit(const Tables& tables, const RelativePoint* points, uint64_t count);
  void merge(const ExtremalPoints& other);
};

}  // namespace sobb::study
