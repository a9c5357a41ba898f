// SPDX-License-Identifier: Apache-2.0
// The orientation of an OBB by the ditetrahedron, DiTO-14 (T. Larsson, L. Källberg, "Fast
// Computation of Tight-Fitting Oriented Bounding Boxes", 2011).
#pragma once

#include "bounds/basis.h"
#include "volumes/extremal_points.h"

namespace sobb::study {

// Three orthonormal directions, within rounding: the best for the 14 extremal points among those
// that have two axes in a face of the ditetrahedron, one of them along an edge, and the axes of
// space. Cost: up to 21 candidates, each 42 products.
void ditetrahedron_basis(const ExtremalPoints& extremal, Direction basis[3]);

}  // namespace sobb::study
