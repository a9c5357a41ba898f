// SPDX-License-Identifier: Apache-2.0
// The vector code of the build: fits k-DOPs to points, and searches the basis of least area.
#pragma once

#include <cstdint>
#include <limits>

#include "bounds/basis_table.h"
#include "bounds/directions/direction_table.h"
#include "bounds/kdop.h"
#include "sobb/sobb.h"

namespace sobb {

// A point relative to the scene's centre, rounded once.
struct RelativePoint {
  float x, y, z;
};

// G[i][j] = sum over volumes c of weight_c d_i d_j, d the widths of c's k-DOP. The weighted sum of
// the areas that the volumes have in the basis (i, j, l) is then 2 (G_ij + G_jl + G_li) / |det|
// (the slab form, summed): one volume's area or eight's cost the same to compare.
struct alignas(64) Gram {
  float sum[kMaxDirections][kMaxDirections];
};

struct BasisChoice {
  uint16_t basis = kAxesBasis;  // its three directions in rising order
  float area = std::numeric_limits<float>::infinity();
};

// Three directions of a table, in rising order, and the area of a volume in their basis.
struct TripleChoice {
  uint32_t direction[3] = {0, 1, 2};
  float area = std::numeric_limits<float>::infinity();
};

// The weighted sum of areas in a basis, to the last bit as choose() computes it.
float area_in_basis(const BasisTable& table, const Gram& gram, uint16_t basis);

// Returns a volume's choice, or the table's frame where that has less area. (In a round volume the
// narrowest slab can lead strategies k and k^2 to something worse than the frame.)
TripleChoice or_frame(const BasisTable& table, const float* width, const TripleChoice& choice);

// One set per sobb_isa; all return the same bits.
struct BoundsKernels {
  // Fits the k-DOP of points: lower = min n . p - e, upper = max n . p + e, where
  // e = 6 u (|n_x| max|p_x| + |n_y| max|p_y| + |n_z| max|p_z|), u = 2^-24, covers the rounding of
  // p - c (u), of the dot product (3 u) and of the widening itself (2 u).
  void (*fit)(const DirectionTable& directions, const RelativePoint* points, uint64_t count,
              Kdop& kdop);
  // Computes the widths of a k-DOP times `scale`; they are zero past the table's count.
  void (*widths)(const Kdop& kdop, float scale, float width[kMaxDirections]);
  // Adds one volume to a Gram matrix. Widths are scaled (by one over the scene's radius), so that
  // no product overflows.
  void (*add_to_gram)(const Kdop& kdop, float scale, float weight, Gram& gram);
  // Finds the basis of least area of one volume by a strategy; of equal areas the one of the lowest
  // indices. `width` has table.stride() widths, scaled as above; those past the count do not
  // matter.
  TripleChoice (*choose_one)(const BasisTable& table, const float* width, sobb_strategy strategy);
  // Does the same for the volumes of a Gram matrix. The table has at most kMaxDirections.
  BasisChoice (*choose)(const BasisTable& table, const Gram& gram, sobb_strategy strategy);
};

const BoundsKernels& bounds_kernels(sobb_isa isa);

}  // namespace sobb
