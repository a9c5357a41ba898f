// SPDX-License-Identifier: Apache-2.0
// What the node tests of many rays read of each: the coefficients of the table's first three
// directions (slab_coefficients-inl.h), and what those of other directions are made from.
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
