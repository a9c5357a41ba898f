// SPDX-License-Identifier: Apache-2.0
// The vector code of the topology: binned surface area heuristic (I. Wald, "On Fast Construction of
// SAH-based Bounding Volume Hierarchies", 2007), with leaves that are made of blocks of triangles.
#pragma once

#include <cstdint>
#include <limits>
#include <memory_resource>
#include <vector>

#include "build/sah_costs.h"
#include "build/topology.h"
#include "format/layout.h"

namespace sobb {

// A box as one vector: lanes 0 to 2 its lower, 4 to 6 its upper corner, negated, so that boxes grow
// by one minimum. Lane 3 of a reference's box holds its primitive, elsewhere lanes 3 and 7 are
// void.
struct alignas(32) FlatBox {
  float at[8];

  static constexpr FlatBox nothing() {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    return {{kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}};
  }
  Box box() const { return {{at[0], at[1], at[2]}, {-at[4], -at[5], -at[6]}}; }
};

// A triangle while it is sorted into the hierarchy.
struct alignas(32) SahReference {
  float lower[3];
  uint32_t primitive;
  float minus_upper[3];
  uint32_t unused;

  static SahReference of(const Box& box, uint32_t primitive) {
    return {{box.lower[0], box.lower[1], box.lower[2]},
            primitive,
            {-box.upper[0], -box.upper[1], -box.upper[2]},
            0};
  }
};
static_assert(sizeof(SahReference) == sizeof(FlatBox));

// The least and the greatest of the references' centres, doubled. Lane 3 is zero.
struct alignas(16) Centres {
  float lower[4];
  float upper[4];

  static constexpr Centres nothing() {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    return {{kNone, kNone, kNone, kNone}, {-kNone, -kNone, -kNone, -kNone}};
  }
};

// A node under way.
struct SahNode {
  FlatBox box;
  Centres centres;
  uint64_t begin;  // of its references
  uint64_t count;
};

inline constexpr uint32_t kMaxBins = 32;

// Below it halves are taken as they come, so that no depth passes the file's limit: coincident
// centres and rows of ever smaller triangles would.
inline constexpr uint32_t kDeepestSplit = kMaxDepth - 32;

// Which bin of each axis a reference falls into: (centre - base) * scale, rounded down.
struct alignas(16) Binning {
  float base[4];
  float scale[4];  // zero along an axis without extent
  uint32_t count;
};

struct alignas(64) Bins {
  FlatBox box[3][kMaxBins];
  uint32_t count[3][kMaxBins];
};

struct Split {
  float cost = std::numeric_limits<float>::infinity();  // of both sides, over the node's area
  int axis = -1;                                        // none
  uint32_t bin = 0;                                     // the right side's first
  uint64_t left_count = 0;
  FlatBox box[2];
};

// A part of the hierarchy that one thread builds.
struct SahSubtree {
  SahNode node;
  uint32_t depth;        // nodes above it
  SahReference* at[2];   // both arrays, the references in the first
  uint32_t* primitives;  // what is in leaves, in their order
  TopologyNode root;
  std::pmr::vector<NodePair> pairs;

  SahSubtree(const SahNode& node, std::pmr::memory_resource& memory) : node(node), pairs(&memory) {}
};

// One set a sobb_isa; all return the same bits.
struct SahKernels {
  void (*clear)(Bins& bins, uint32_t count);
  void (*bin)(const SahReference* references, uint64_t count, const Binning& binning, Bins& bins);
  void (*merge)(const Bins& from, uint32_t count, Bins& into);
  // The split of least cost; equal costs go to the lowest axis, then the lowest bin.
  Split (*find_split)(const SahNode& node, const Bins& bins, uint32_t count);
  // Stable: to `left` and `right` in the order they come in. Adds to both sides' centres.
  void (*partition)(const SahReference* references, uint64_t count, const Binning& binning,
                    const Split& split, SahReference* left, SahReference* right,
                    Centres centres[2]);
  // Adds to a node's box and centres.
  void (*bound)(const SahReference* references, uint64_t count, FlatBox& box, Centres& centres);
  // Makes the root and pairs of a subtree.
  void (*build)(SahSubtree& subtree);
};

const SahKernels& sah_kernels(sobb_isa isa);

// Of a node.
Binning make_binning(const Centres& centres, uint64_t count);

}  // namespace sobb
