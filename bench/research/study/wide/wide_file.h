// SPDX-License-Identifier: Apache-2.0
// A hierarchy of the library out of a choice of wide nodes, by the library's own volumes, file and
// checks.
#pragma once

#include <memory>

#include "builder/mesh.h"
#include "sobb/sobb.h"
#include "study/wide/wide_layout.h"

namespace sobb::study {

// SOBBs of k = 64 by strategy k^2, in nodes of room for 4 or 8 children. The file is opened as any
// other, so that it is proven to hold every node and block once.
std::shared_ptr<sobb_hierarchy> make_hierarchy(const Mesh& mesh, const MeshSummary& summary,
                                               const WideLayout& layout, uint32_t width);

}  // namespace sobb::study
