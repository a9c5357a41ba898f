// SPDX-License-Identifier: Apache-2.0
// Making a file image, and putting it on the disk atomically.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/scheduler.h"
#include "format/image.h"
#include "format/layout.h"

namespace sobb {

// The sizes that a file's layout depends on.
struct Shape {
  uint32_t width = 8;
  uint32_t direction_count = 3;
  uint64_t node_count = 0;
  uint64_t block_count = 0;
};

// An image in the making: allocated and laid out by begin_image(), its parts filled by the build,
// then sealed. All bytes not written are zero.
struct ImageParts {
  FileHeader* header;  // volume, depth, centre, radius, triangle_count are the build's to fill
  std::span<Direction> directions;
  void* nodes;  // shape.node_count of Node<shape.width>
  std::span<TriangleBlock> blocks;
  BuildRecord* record;
};

// Allocates the image, writes magic, version, sizes and section table. O(1) but for the zeroing,
// which for nodes and blocks may be left to the threads that fill them.
enum class Zeroed { kAll, kAllButNodesAndBlocks };
Image begin_image(std::shared_ptr<Memory> memory, const Shape& shape, ImageParts& parts,
                  Zeroed zeroed = Zeroed::kAll);

// Computes the checksums, in parallel; the image is then a valid file.
void seal_image(Image& image, const Scheduler& scheduler);

// Writes bytes to a temporary name beside `path`, syncs, renames, syncs the folder. Where `path` is
// a link, the file that it leads to is replaced. What exists and is no regular file is left alone.
// Error FILE_WRITE with path and reason; the old file is then as it was, no temporary left.
void save_atomically(std::span<const std::byte> bytes, const char* path);

}  // namespace sobb
