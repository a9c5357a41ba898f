// SPDX-License-Identifier: Apache-2.0
// Making a file image, and putting it on the disk.
//
// The room `format/writer` makes images and files; it knows `format`'s layout, checksums and
// images. save.cpp replaces a file whole or not at all, by way of temporary_file.
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

// What the header says besides the file's shape; layout.h explains the fields.
struct HeaderFields {
  uint32_t volume;
  uint32_t depth;
  float centre[3];
  float radius;
  uint64_t triangle_count;
};

// The sections of an image, to be filled by the build.
struct ImageParts {
  std::span<Direction> directions;
  BuildRecord* record;
  void* nodes;  // shape.node_count of Node<shape.width>
  std::span<TriangleBlock> blocks;
};

// Allocates an image and lays out its sections, whose bytes are zero. Takes O(1) but for the
// zeroing; the zeroing of nodes and blocks may be left to the threads that fill them.
enum class Zeroed { kAll, kAllButNodesAndBlocks };
Image begin_image(std::shared_ptr<Memory> memory, const Shape& shape, ImageParts& parts,
                  Zeroed zeroed = Zeroed::kAll);

// Writes the header and the section table of an image whose sections are filled, with their
// checksums, computed in parallel. The image is then a valid file.
void finish_image(Image& image, const Shape& shape, const HeaderFields& fields,
                  const Scheduler& scheduler);

// Writes bytes to a temporary name beside `path`, syncs, renames, and syncs the folder. Where
// `path` is a link, replaces the file that it leads to. Refuses to replace what is no regular file.
// Error FILE_WRITE with path and reason; the old file is then as it was, and no temporary is left.
void save_atomically(std::span<const std::byte> bytes, const char* path);

}  // namespace sobb
