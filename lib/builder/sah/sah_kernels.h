// SPDX-License-Identifier: Apache-2.0
// The vector code of the topology: binned surface area heuristic (I. Wald, "On Fast Construction of
// SAH-based Bounding Volume Hierarchies", 2007), with leaves that are made of blocks of triangles,
// and spatial splits (M. Stich, H. Friedrich, A. Dietrich, "Spatial Splits in Bounding Volume
// Hierarchies", 2009).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <vector>

#include "builder/sah/sah_costs.h"
#include "builder/topology/topology.h"
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

// A triangle, or where a spatial split cut it a part, while it is sorted into the hierarchy.
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
  Box box() const {
    return {{lower[0], lower[1], lower[2]}, {-minus_upper[0], -minus_upper[1], -minus_upper[2]}};
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

struct SahExtent {
  FlatBox box;
  Centres centres;

  static constexpr SahExtent nothing() { return {FlatBox::nothing(), Centres::nothing()}; }

  void grow(const SahExtent& other) {
    for (int k = 0; k < 8; ++k) box.at[k] = std::min(box.at[k], other.box.at[k]);
    for (int k = 0; k < 3; ++k) {
      centres.lower[k] = std::min(centres.lower[k], other.centres.lower[k]);
      centres.upper[k] = std::max(centres.upper[k], other.centres.upper[k]);
    }
  }
};

// A node under way.
struct SahNode {
  SahExtent extent;
  uint64_t begin;  // of its references
  uint64_t count;
  uint64_t room;  // for more of them, behind these
};

inline constexpr uint32_t kMaxBins = 32;
inline constexpr uint32_t kSpatialBins = 16;
inline constexpr uint32_t kLengthBins = 16;

// Below it halves are taken as they come, so that no depth passes the file's limit: coincident
// centres and rows of ever smaller triangles would.
inline constexpr uint32_t kDeepestSplit = kMaxDepth - 32;

// What references are told apart by.
enum class SplitKind : uint8_t {
  kCentres,  // of their boxes
  kLengths,  // of their boxes' longest sides: one bin for about each factor of the root of two,
             // along the first axis
  kPlanes,   // each is in all bins that it meets, and is cut: a spatial split
};
inline constexpr SplitKind kSplitKinds[] = {SplitKind::kCentres, SplitKind::kLengths,
                                            SplitKind::kPlanes};

// How references fall into bins. By centres and planes the bin is (number - base) * scale along
// each axis, rounded down.
struct alignas(16) Binning {
  float base[4];   // by lengths, the longest
  float scale[4];  // zero along an axis without extent
  uint32_t count;  // none: not worth a look
  SplitKind kind;
};

struct alignas(64) Bins {
  FlatBox box[3][kMaxBins];
  uint32_t count[3][kMaxBins];  // references that begin there
  uint32_t ends[3][kMaxBins];   // by planes: that end there
};

struct Split {
  float cost = std::numeric_limits<float>::infinity();  // of both sides, over the node's area
  int axis = -1;                                        // none
  uint32_t bin = 0;                                     // the right side's first
  uint64_t count[2] = {0, 0};                           // of the sides, by the bins
  uint64_t placed[2] = {0, 0};                          // less: some are not cut
  FlatBox box[2];                                       // of the sides, by the bins
  Binning binning;
};

// What spatial splits cut, and where.
struct Cutting {
  const Mesh& mesh;
  const Frame& frame;
  double least_overlap;  // half the area that both sides of a split have in common
};

// A part of the hierarchy that one thread builds.
struct SahSubtree {
  SahNode node;
  uint32_t depth;                    // nodes above it
  SahReference* at[2];               // both arrays, the references in the first
  uint32_t* primitives;              // what is in leaves, where their references begin
  Box* boxes;                        // likewise; none without spatial splits
  const Cutting* cutting = nullptr;  // likewise
  TopologyNode root;
  std::pmr::vector<NodePair> pairs;

  SahSubtree(const SahNode& node, std::pmr::memory_resource& memory) : node(node), pairs(&memory) {}
};

// One set a sobb_isa; all return the same bits.
struct SahKernels {
  void (*clear)(Bins& bins, const Binning& binning);
  // `cutting` is for planes.
  void (*bin)(const SahReference* references, uint64_t count, const Binning& binning,
              const Cutting* cutting, Bins& bins);
  void (*merge)(const Bins& from, const Binning& binning, Bins& into);
  // The split of least cost for which there is room; equal costs go to the lowest axis, then the
  // lowest bin.
  Split (*find_split)(const SahNode& node, const Bins& bins, const Binning& binning);
  // How many references go to either side of a split by planes.
  void (*count_parts)(const SahReference* references, uint64_t count, const SahNode& node,
                      const Split& split, const Cutting& cutting, uint64_t placed[2]);
  // Stable: to `left` and `right` in the order they come in. Adds to both sides' extents.
  void (*partition)(const SahReference* references, uint64_t count, const SahNode& node,
                    const Split& split, const Cutting* cutting, SahReference* left,
                    SahReference* right, SahExtent side[2]);
  void (*bound)(const SahReference* references, uint64_t count, SahExtent& extent);
  // Makes the root and pairs of a subtree.
  void (*build)(SahSubtree& subtree);
};

const SahKernels& sah_kernels(sobb_isa isa);

// Of a node, to find a split better than the best so far. `cutting` may be null.
Binning make_binning(SplitKind kind, const SahNode& node, const Split& best,
                     const Cutting* cutting);

// Whether a split should replace the best so far, of another kind.
bool is_better(const SahNode& node, const Split& split, const Split& best);

// The sides of a split, of so many references, as nodes without extent: next to each other, the
// node's room shared out by their counts.
void place_sides(const SahNode& node, const uint64_t count[2], SahNode side[2]);

}  // namespace sobb
