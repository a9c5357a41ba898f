// SPDX-License-Identifier: Apache-2.0
// split_fibres() parts triangles into two clusters by orientation, for hair and fur (S. Woop et
// al., Exploiting Local Orientation Similarity for Efficient Ray Traversal of Hair and Fur, 2014).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bounds/area.h"
#include "builder/mesh.h"
#include "study/binary/binary_tree.h"

namespace sobb::study {

// The direction of every triangle's longest edge, which is a fibre's tangent. It is a unit vector
// whose sign has no meaning, and zero for a triangle that is a point.
std::vector<Vector> fibre_tangents(const Mesh& mesh);

// The means of two clusters of lines.
struct FibreSplit {
  Vector mean[2];

  // True where a line is nearer to the second mean.
  bool is_second(const Vector& tangent) const;
};

// Runs two-means over lines. It starts from two lines far apart: the one at the largest angle to
// the first reference's, and the one at the largest angle to that. Returns nothing where all are
// parallel.
std::optional<FibreSplit> split_fibres(std::span<const Reference> references,
                                       const std::vector<Vector>& tangents);

}  // namespace sobb::study
