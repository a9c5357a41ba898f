// SPDX-License-Identifier: Apache-2.0
// A numerical search finds the skewed box of least area with any three normals. Tables of
// directions are measured against it.
#pragma once

#include <array>
#include <span>

#include "bounds/basis.h"
#include "study/areas/point_set.h"

namespace sobb::study {

using Normals = std::array<Direction, 3>;

// The area of the points' skewed box with these normals; infinite where the normals are closer to a
// plane than a table allows (kSmallestDeterminant).
double area_with(const PointSet& points, const Normals& normals);

// The least area that local searches from the given normals, and from some random ones, find.
double optimise_normals(const PointSet& points, std::span<const Normals> starts);

}  // namespace sobb::study
