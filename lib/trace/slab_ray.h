// SPDX-License-Identifier: Apache-2.0
// What node tests read of a ray where there are many: the coefficients of the table's first three
// directions (ray_table-inl.h), and what those of the others are made of.
#pragma once

namespace sobb {

struct alignas(64) SlabRay {
  float reciprocal[3];
  float tmin;
  float near[3];
  float scale;
  float far[3];
  float error;
  float origin[4];  // the fourth is void, here and below
  float direction[4];
};

}  // namespace sobb
