// SPDX-License-Identifier: Apache-2.0
// The ways to make a hierarchy that the study compares: how it is split, what its leaves are, and
// how binary nodes become wide ones.
#pragma once

#include <functional>
#include <memory_resource>
#include <vector>

#include "builder/mesh.h"
#include "study/binary/area_measure.h"
#include "study/wide/wide_cut.h"

namespace sobb::study {

enum class Layout { kBinary, kWide };

// A hierarchy's triangles and nodes, before volumes.
struct Variant {
  const char* splits;    // how the binary hierarchy was made
  const char* leaves;    // how its leaves were
  const char* collapse;  // how wide nodes were; "none" for a binary one
  Layout layout;
  BinaryTree tree;
  WideCut cut;
  double topology_ms;  // processor time of splits and, but for an exact collapse, of leaves
  double collapse_ms;  // of areas and wide nodes, and of leaves chosen with them
};

// Makes the variants one after the other. The first is the library's own.
void each_variant(const Mesh& mesh, const MeshSummary& summary, std::pmr::memory_resource& memory,
                  const std::function<void(const Variant&)>& visit);

}  // namespace sobb::study
