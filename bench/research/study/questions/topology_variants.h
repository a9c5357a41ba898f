// SPDX-License-Identifier: Apache-2.0
// each_variant() makes the hierarchies that the study compares. They differ in how they are split,
// what their leaves are, and how binary nodes become wide ones.
#pragma once

#include <functional>
#include <memory_resource>
#include <vector>

#include "builder/mesh.h"
#include "study/binary/area_measure.h"
#include "study/wide/wide_cut.h"

namespace sobb::study {

enum class Layout { kBinary, kWide };

// A hierarchy's triangles and nodes, without volumes.
struct Variant {
  const char* splits;    // how the binary hierarchy was split
  const char* leaves;    // how its leaves were chosen
  const char* collapse;  // how wide nodes were chosen; "none" for a binary hierarchy
  Layout layout;
  BinaryTree tree;
  WideCut cut;
  double topology_ms;  // processor time of splits, and of leaves unless the collapse chooses them
  double collapse_ms;  // processor time of areas and wide nodes, and of leaves chosen with them
};

// Makes the variants one after the other. Those whose splits are named "embree" are left out in
// builds without Embree.
void each_variant(const Mesh& mesh, const MeshSummary& summary, std::pmr::memory_resource& memory,
                  const std::function<void(const Variant&)>& visit);

}  // namespace sobb::study
