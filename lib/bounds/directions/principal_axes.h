// SPDX-License-Identifier: Apache-2.0
// Orthogonal frames, and those of symmetric matrices.
#pragma once

#include "bounds/area.h"

namespace sobb {

// Three perpendicular unit vectors.
struct OrthogonalFrame {
  Vector axis[3];
};

// The eigenvectors of a symmetric matrix, in no order, by Jacobi's method.
OrthogonalFrame principal_axes(const Vector (&matrix)[3]);

}  // namespace sobb
