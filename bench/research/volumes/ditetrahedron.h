// SPDX-License-Identifier: Apache-2.0
// The ditetrahedron chooses the orientation of an OBB: DiTO-14 (T. Larsson, L. Källberg, "Fast
// Computation of Tight-Fitting Oriented Bounding Boxes", 2011).
#pragma once

#include "bounds/basis.h"
#include "volumes/extremal_points.h"

namespace sobb::study {

// Finds three orthonormal directions, within rounding: the best for the 14 extremal points among
// the axes of space and the bases with one direction along an edge of the ditetrahedron and one
// along the normal of its face. Cost: up to 21 candidates, each 42 products.
void ditetrahedron_basis(const ExtremalPoints& extremal, Direction basis[3]);

}  // namespace sobb::study
