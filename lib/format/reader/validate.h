// SPDX-License-Identifier: Apache-2.0
// The steps of the proof that read_image() makes, in their order. Each relies on those before it.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>

#include "base/progress.h"
#include "base/scheduler.h"
#include "format/reader/reader.h"

namespace sobb {

// A file that is being read, as every step takes it.
struct Reading {
  std::span<const std::byte> bytes;
  const char* name;  // of the file, for messages
  const Scheduler& scheduler;
  std::pmr::memory_resource& scratch;
  Progress& progress;
};

// Where the steps end on the scale of the progress, by measured time. Each step reports about once
// per MiB, so that the caller may stop a file of any size at once.
inline constexpr double kChecksumsEnd = 0.7;
inline constexpr double kBlocksEnd = 0.8;
inline constexpr double kNodesEnd = 0.9;

// The largest magnitudes that a file may hold. Vertices and the centre are within 2^60 on each
// axis, so no vertex is further than 2^62 from the centre, along any direction.
inline constexpr float kMaxCoordinate = 0x1p60f;
inline constexpr float kMaxExtent = 0x1p62f;

// Returns false for NaN.
constexpr bool within(float value, float limit) { return value >= -limit && value <= limit; }

// Magic, version, sizes, the checksum of header and section table, features, fields.
const FileHeader& validate_header(const Reading& reading);

// Section table and gaps, then sizes and checksums. view_of() may then be called.
void validate_sections(const Reading& reading, const FileHeader& header);

void validate_directions(const Reading& reading, const FileView& view);
void validate_record(const Reading& reading, const FileView& view);

// Each block by itself: vertices, primitives, lanes packed low.
void validate_blocks(const Reading& reading, const FileView& view);

// Each node by itself: meta, slabs, bases; references forward and in range; leaves' lanes filled.
void validate_nodes(const Reading& reading, const FileView& view);

// The nodes together: a tree of the depth that the header states, every block in one leaf. Holds
// one byte per node and one bit per block.
void validate_tree(const Reading& reading, const FileView& view);

// The number of a block's lanes that hold a triangle; validate_blocks() has proved them the lowest.
constexpr uint32_t used_lanes(const TriangleBlock& block) {
  uint32_t used = 0;
  for (const uint32_t primitive : block.primitive) used += primitive != kNoPrimitive;
  return used;
}

}  // namespace sobb
