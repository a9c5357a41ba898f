// SPDX-License-Identifier: Apache-2.0
// A binary hierarchy by Embree's builder, at medium quality, over the triangles' boxes.
#pragma once

#include "builder/mesh.h"
#include "study/binary/binary_tree.h"

namespace sobb::study {

// Only in builds with Embree (SOBB_EMBREE_MAJOR). Throws std::runtime_error where Embree fails.
BinaryTree embree_tree(const Mesh& mesh);

}  // namespace sobb::study
