// SPDX-License-Identifier: Apache-2.0
// dop_area() measures the surface of an intersection of slabs.
#pragma once

#include <span>

#include "bounds/basis.h"

namespace sobb::study {

// slab[k] are the planes n_k . p = slab[k][0] and slab[k][1]; the first three normals are the axes.
// Each plane's face is a large square, clipped by all other slabs. It takes some microseconds.
double dop_area(std::span<const Direction> normals, const float (*slab)[2]);

}  // namespace sobb::study
