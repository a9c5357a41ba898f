// SPDX-License-Identifier: Apache-2.0
// The vector code of the topology: binned surface area heuristic (I. Wald, "On Fast Construction of
// SAH-based Bounding Volume Hierarchies", 2007), with leaves that are made of blocks of triangles,
// and spatial splits (M. Stich, H. Friedrich, A. Dietrich, "Spatial Splits in Bounding Volume
// Hierarchies", 2009).
//
// The room `builder/sah` splits one node, or builds one subtree: sah_bins-inl.h bins references by
// their centres, sah_cuts-inl.h cuts them at planes, sah_kinds-inl.h tells large triangles from
// small ones, sah_subtree-inl.h builds a subtree by all three. It knows `builder/boxes`; only
// `builder/topology` calls it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <vector>

#include "builder/boxes/binary_nodes.h"
#include "builder/boxes/frame.h"
#include "builder/sah/sah_costs.h"
#include "format/layout.h"
#include "sobb/sobb.h"

namespace sobb {

// A box as one vector: lanes 0 to 2 are its lower corner, lanes 4 to 6 its upper corner, negated,
// so that one minimum grows a box. What lanes 3 and 7 hold does not count.
struct alignas(32) FlatBox {
  float at[8];

  static constexpr FlatBox nothing() {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    return {{kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone}};
  }
  Box box() const { return {{at[0], at[1], at[2]}, {-at[4], -at[5], -at[6]}}; }
};

// A triangle, or a part of one that spatial splits cut, while it is sorted into the hierarchy. It
// is a FlatBox that uses lanes 3 and 7.
struct alignas(32) SahReference {
  float lower[3];
  uint32_t primitive;
  float minus_upper[3];
  uint32_t is_cut;  // 1: a part of the triangle, 0: all of it

  static SahReference whole(const Box& box, uint32_t primitive) {
    return {{box.lower[0], box.lower[1], box.lower[2]},
            primitive,
            {-box.upper[0], -box.upper[1], -box.upper[2]},
            0};
  }
  static SahReference part(const Box& box, uint32_t primitive) {
    SahReference reference = whole(box, primitive);
    reference.is_cut = 1;
    return reference;
  }
  Box box() const {
    return {{lower[0], lower[1], lower[2]}, {-minus_upper[0], -minus_upper[1], -minus_upper[2]}};
  }
};
static_assert(sizeof(SahReference) == sizeof(FlatBox));

// The least and the greatest coordinates of the references' centres, doubled. Lane 3 is zero.
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

// A node that is not split yet.
struct SahNode {
  SahExtent extent;
  uint64_t begin;  // its first reference
  uint64_t count;  // of its references
  uint64_t room;   // behind them, for the references that spatial splits add
};

inline constexpr uint32_t kMaxBins = 32;
inline constexpr uint32_t kSpatialBins = 16;
inline constexpr uint32_t kLengthBins = 16;

// From this depth on nodes are halved without a search, so that no depth passes the file's limit:
// coincident centres and rows of ever smaller triangles would.
inline constexpr uint32_t kDeepestSplit = kMaxDepth - 32;

// What a split tells references apart by.
enum class SplitKind : uint8_t {
  kCentres,  // the centres of their boxes
  kLengths,  // the longest sides of their boxes: one bin for about each factor of the root of two,
             // along the first axis
  kPlanes,   // a plane that cuts them: each is in all bins that it meets (a spatial split)
};
inline constexpr SplitKind kSplitKinds[] = {SplitKind::kCentres, SplitKind::kLengths,
                                            SplitKind::kPlanes};

// How references fall into bins. By centres and planes the bin is (number - base) * scale along
// each axis, rounded down.
struct alignas(16) Binning {
  float base[4];   // by lengths, the longest
  float scale[4];  // zero along an axis without extent
  uint32_t count;  // zero: no split of this kind is worth a search
  SplitKind kind;
};

struct alignas(64) Bins {
  FlatBox box[3][kMaxBins];
  uint32_t count[3][kMaxBins];  // references that begin in the bin
  uint32_t ends[3][kMaxBins];   // references that end in the bin; for planes only
};

struct Split {
  float cost = std::numeric_limits<float>::infinity();  // of both sides, over the node's area
  int axis = -1;                                        // -1: there is no split
  uint32_t bin = 0;                                     // the right side's first
  uint64_t count[2] = {0, 0};   // references of either side, as the bins count them
  uint64_t placed[2] = {0, 0};  // the same once some are left whole: no more than `count`
  FlatBox box[2];               // the boxes of either side, as the bins have them
  Binning binning;
};

// What spatial splits need: the triangles, the frame whose axes planes lie across, and when to try.
struct Cutting {
  const Mesh& mesh;
  const Frame& frame;
  double least_overlap;  // half the area that the sides of another split must have in common
};

// A part of the hierarchy that one thread builds.
struct SahSubtree {
  SahNode node;
  uint32_t depth;       // nodes above it
  SahReference* at[2];  // the two arrays; the first holds the references
  // Receive the references in leaves, as struct References has them, each leaf's where its
  // references begin in the arrays, from `first` on.
  uint32_t* primitives;
  uint64_t first = 0;
  Box* cuts = nullptr;               // null without spatial splits
  const Cutting* cutting = nullptr;  // null without spatial splits
  // Nodes of at most so many references are split in the middle instead of where the surface area
  // heuristic says: faster, and nearly as good where little is left to gain.
  uint64_t middle_count = 0;
  TopologyNode root;
  std::pmr::vector<NodePair> pairs;

  SahSubtree(const SahNode& node, std::pmr::memory_resource& memory) : node(node), pairs(&memory) {}
};

// One set per sobb_isa; all return the same bits.
struct SahKernels {
  void (*clear)(Bins& bins, const Binning& binning);
  // `cutting` is for planes; other kinds take null.
  void (*bin)(const SahReference* references, uint64_t count, const Binning& binning,
              const Cutting* cutting, Bins& bins);
  void (*merge)(const Bins& from, const Binning& binning, Bins& into);
  // The split of least cost for which there is room; equal costs go to the lowest axis, then the
  // lowest bin.
  Split (*find_split)(const SahNode& node, const Bins& bins, const Binning& binning);
  // How many references go to either side of a split by planes.
  void (*count_parts)(const SahReference* references, uint64_t count, const SahNode& node,
                      const Split& split, const Cutting& cutting, uint64_t placed[2]);
  // Writes the references to `left` and `right` in the order they come in, and grows the extents of
  // both sides.
  void (*partition)(const SahReference* references, uint64_t count, const SahNode& node,
                    const Split& split, const Cutting* cutting, SahReference* left,
                    SahReference* right, SahExtent side[2]);
  void (*bound)(const SahReference* references, uint64_t count, SahExtent& extent);
  // Makes the root and pairs of a subtree.
  void (*build)(SahSubtree& subtree);
};

const SahKernels& sah_kernels(sobb_isa isa);

// The binning by which to look for a split of a node that is better than its best so far. `cutting`
// may be null.
Binning make_binning(SplitKind kind, const SahNode& node, const Split& best,
                     const Cutting* cutting);

// Tells whether `split` should replace `best`, a split of another kind.
bool is_better(const SahNode& node, const Split& split, const Split& best);

// Makes the sides of a split as nodes without extent, of `count` references each: next to each
// other, with the node's room shared out by their counts.
void place_sides(const SahNode& node, const uint64_t count[2], SahNode side[2]);

}  // namespace sobb
