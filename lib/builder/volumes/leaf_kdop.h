// SPDX-License-Identifier: Apache-2.0
// The k-DOP of a leaf.
#pragma once

#include "bounds/bounds_kernels.h"
#include "builder/boxes/frame.h"
#include "builder/boxes/references.h"
#include "builder/mesh.h"

namespace sobb {

// Fits the k-DOP of a leaf's triangles, at most kMaxLeafReferences of them, each cut to its
// reference's box. The boxes lie along `frame`, in which the topology was built.
void fit_leaf(const Mesh& mesh, const References& leaf, const DirectionTable& directions,
              const float centre[3], const BoundsKernels& kernels, Kdop& kdop,
              const Frame& frame = Frame());

}  // namespace sobb
