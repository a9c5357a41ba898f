// SPDX-License-Identifier: Apache-2.0
// Two clusters of triangles by orientation, for hair and fur (S. Woop et al., Exploiting Local
// Orientation Similarity for Efficient Ray Traversal of Hair and Fur, 2014).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bounds/area.h"
#include "builder/mesh.h"
#include "study/binary/binary_tree.h"

namespace sobb::study {

// The direction of every triangle's longest edge: a fibre's tangent. Unit vectors, their signs
// without meaning; zero for a triangle that is a point.
std::vector<Vector> fibre_tangents(const Mesh& mesh);

// The means of two clusters of lines.
struct FibreSplit {
  Vector mean[2];

  // Which cluster a line is nearer to.
  bool is_second(const Vector& tangent) const;
};

// Two-means over lines. It starts from two lines far apart: that at the largest angle to the first
// reference's, and that at the largest angle to it. Nothing where all are parallel.
std::optional<FibreSplit> split_fibres(std::span<const Reference> references,
                                       const std::vector<Vector>& tangents);

}  // namespace sobb::study
