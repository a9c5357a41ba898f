// SPDX-License-Identifier: Apache-2.0
// Three perpendicular unit vectors, and those along which a scene's directions lie most and least.
#pragma once

#include "bounds/area.h"

namespace sobb {

struct OrthogonalFrame {
  Vector axis[3];
};

// The eigenvectors of a symmetric matrix, in no order, by Jacobi's method.
OrthogonalFrame principal_axes(const Vector (&matrix)[3]);

}  // namespace sobb
