// SPDX-License-Identifier: Apache-2.0
// A file image as typed pointers: what tracing, statistics and validation see.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "format/layout.h"
#include "sobb/sobb.h"

namespace sobb {

// Borrowed from an image; valid while that lives.
struct FileView {
  const FileHeader* header = nullptr;
  std::span<const Direction> directions;
  sobb_table table = SOBB_TABLE_DEFAULT;  // how the directions were chosen
  const void* nodes = nullptr;            // Node<header->width>
  uint64_t node_count = 0;
  std::span<const TriangleBlock> blocks;
  const BuildRecord* record = nullptr;

  template <int W>
  std::span<const Node<W>> nodes_of() const {
    return {static_cast<const Node<W>*>(nodes), node_count};
  }
};

// Makes the view of an image that is complete: its header and section table lead to bytes of the
// image, and no section is missing. Leaves `table` to the caller, since the file does not say it.
FileView view_of(std::span<const std::byte> bytes);

}  // namespace sobb
