// SPDX-License-Identifier: Apache-2.0
// make_hierarchy() turns a choice of wide nodes into a hierarchy of the library, with the library's
// own volumes, file and checks.
#pragma once

#include <memory>

#include "builder/mesh.h"
#include "sobb/sobb.h"
#include "study/wide/wide_layout.h"

namespace sobb::study {

// Its SOBBs are those of k = 64 by strategy k^2, its nodes have room for 4 or 8 children. The file
// is opened as any other, which proves that it holds every node and block once.
std::shared_ptr<sobb_hierarchy> make_hierarchy(const Mesh& mesh, const MeshSummary& summary,
                                               const WideLayout& layout, uint32_t width);

}  // namespace sobb::study
