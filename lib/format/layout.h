// SPDX-License-Identifier: Apache-2.0
// Version 1 of the file as structs: docs/format.md in code. Little-endian, fixed-width,
// relocatable. The nodes and triangle blocks of the file are those that the kernels trace.
//
// `lib/format` is the file: its layout and checksums, an image of it in memory, the view of an
// image, statistics over a view. The rooms `format/reader` and `format/writer` know these, and not
// each other. `lib/format` knows `lib/base` and `lib/bounds`; the builder writes by it, the tracer
// reads.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "bounds/basis.h"

namespace sobb {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

// No text begins so: a byte above 127, and line ends that a text transfer would change.
inline constexpr uint8_t kMagic[8] = {0xF5, 'S', 'O', 'B', 'B', '\r', '\n', 0x1A};
inline constexpr uint32_t kFormatVersion = 1;
inline constexpr uint64_t kSectionAlignment = 64;
inline constexpr uint64_t kChecksumChunk = uint64_t{1} << 20;
inline constexpr uint32_t kMaxDepth = 96;  // of nodes; bounds the traversal stack
inline constexpr uint32_t kMaxSections = 64;
inline constexpr uint32_t kNoPrimitive = 0xFFFFFFFF;

struct FileHeader {
  uint8_t magic[8];
  uint32_t version;
  uint32_t header_size;  // sizeof(FileHeader); the section table follows
  uint64_t total_size;
  uint64_t header_checksum;  // XXH3-64 of header and section table, this field zero
  uint32_t must_understand;  // features without which the file cannot be traced; none defined
  uint32_t ignorable;        // features that a reader may pass over; none defined
  uint32_t volume;           // a sobb_volume
  uint32_t width;            // W, children per node: 4 or 8
  uint32_t direction_count;  // K: 3 for the AABB, else 16, 24 or 32
  uint32_t section_count;
  uint32_t depth;           // nodes on the longest way down, the root counted
  uint32_t reserved0;       // zero
  float centre[3];          // c: slabs are measured from it
  float radius;             // R: no vertex is further from c
  uint64_t triangle_count;  // primitives are below it
  uint64_t reserved1[5];    // zero
};
static_assert(sizeof(FileHeader) == 128);

enum class SectionId : uint32_t { kDirections = 1, kNodes = 2, kBlocks = 3, kRecord = 4 };

struct Section {
  uint32_t id;        // a SectionId; others are passed over
  uint32_t reserved;  // zero
  uint64_t offset;    // from the file's first byte, a multiple of 64
  uint64_t size;
  uint64_t checksum;  // XXH3-64 over the XXH3-64 of each MiB
};
static_assert(sizeof(Section) == 32);

// Section kDirections holds K directions; those of AABBs are the axes.
static_assert(sizeof(Direction) == 12);

// A node of W children, 32 W bytes, structure of arrays. Child i's volume is the intersection of
// slab[j][0][i] <= n . (p - c) <= slab[j][1][i] over j, n the direction that bits 5j to 5j+4 of
// basis[i] name: 26 bytes. Children are packed low; the lanes above them are zero.
template <int W>
struct alignas(64) Node {
  float slab[3][2][W];
  uint32_t reference[W];  // a node's index, or a leaf's first triangle block
  uint16_t basis[W];
  uint16_t meta[W];
};
static_assert(sizeof(Node<4>) == 128 && sizeof(Node<8>) == 256);

constexpr uint64_t node_size(uint32_t width) { return uint64_t{32} * width; }

// Bits of Node::meta.
inline constexpr uint16_t kLeafBit = 1u << 15;   // the child is a leaf
inline constexpr uint16_t kTriangleMask = 0x3F;  // a leaf's triangles, 1 to 63
inline constexpr uint32_t kChildCountShift = 8;  // child 0 only: four bits, 1 to W
inline constexpr uint16_t kChildCountMask = 0xF << kChildCountShift;
inline constexpr uint16_t kSharedBit = 1u << 12;  // child 0 only: every child has one basis

// The number of a node's children, in any layout with this meta word.
template <class AnyNode>
constexpr uint32_t child_count(const AnyNode& node) {
  return (node.meta[0] & kChildCountMask) >> kChildCountShift;
}

// Returns whether a node needs the table's first three directions, the frame, and no others.
template <class AnyNode>
constexpr bool on_frame(const AnyNode& node) {
  return (node.meta[0] & kSharedBit) != 0 && node.basis[0] == kAxesBasis;
}

// Four triangles, structure of arrays. Unused lanes are zero with primitive kNoPrimitive. A leaf of
// n triangles is ceil(n / 4) consecutive blocks, filled from the first lane on.
struct alignas(16) TriangleBlock {
  float vertex[3][3][4];  // [vertex][axis][lane], in the coordinates of the input
  uint32_t primitive[4];
};
static_assert(sizeof(TriangleBlock) == 160);

constexpr uint64_t blocks_of(uint64_t triangles) { return (triangles + 3) / 4; }

// Section kRecord says how the hierarchy was made, and nothing that differs from run to run.
struct BuildRecord {
  uint32_t quality;   // a sobb_quality but DEFAULT
  uint32_t strategy;  // a sobb_strategy but DEFAULT
  uint64_t degenerate_count;
  uint64_t reference_count;  // triangles in leaves, each spatial split's parts counted
  uint64_t source_hash;      // of the input (builder/mesh.h)
  float bounds_min[3];       // of the vertices that triangles use
  float bounds_max[3];
  uint32_t reserved[2];  // zero
};
static_assert(sizeof(BuildRecord) == 64);

}  // namespace sobb
