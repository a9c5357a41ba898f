// SPDX-License-Identifier: Apache-2.0
// What node tests read of a ray where there are many: the coefficients of the table's first three
// directions (ray_table-inl.h), and what those of the others are made of.
#pragma once

namespace sobb {

struct alignas(64) SlabRay {
  float reciprocal[3];
  float tmin;
  float near[3];
  float limit;  // of the interval, in scaled units; negative once an any-hit ray is done
  float far[3];
  float unused;
  float origin[3];
  float scale;
  float direction[3];
  float error;
};

}  // namespace sobb
