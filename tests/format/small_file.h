// SPDX-License-Identifier: Apache-2.0
// Small valid files made by hand, so that the format is tested without the builder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/error.h"
#include "format/image.h"
#include "format/view.h"
#include "format/writer/writer.h"

namespace sobb::test {

// An image with its parts, for tests to damage. seal() writes the header and makes the file valid,
// where what tests did to the parts allows.
struct SmallFile {
  Image image;
  Shape shape;
  HeaderFields fields;
  ImageParts parts;

  std::span<std::byte> bytes() { return image.bytes(); }
  FileHeader& header();
  std::span<Section> sections();
  template <int W>
  Node<W>& node(int index) {
    return static_cast<Node<W>*>(parts.nodes)[index];
  }
  void seal();
};

// A sealed file of three nodes, twelve triangles, and leaves of 5, 1, 4 and 2 in five blocks:
//   node 0: node 1, leaf of blocks 0 and 1
//   node 1: node 2, leaf of block 2
//   node 2: leaf of block 3, leaf of block 4
// SOBBs have 16 directions; node 1 shares its basis, the others have one per child.
SmallFile make_small_file(sobb_volume volume, uint32_t width);

// The smallest file, sealed: the triangle (0,0,0) (1,0,0) (0,1,0) in a 4-wide AABB node.
SmallFile make_smallest_file();

// A sealed file of AABB nodes, each the only child of the one before, with a leaf under the last.
SmallFile make_chain(uint32_t node_count);

// A sealed file of full AABB nodes whose children are leaves of one and the same triangle, but for
// one child per node: the next node. It is the first child of the first `turn` nodes and the last
// child of the others.
SmallFile make_comb(uint32_t width, uint32_t node_count, uint32_t turn);

// A copy of arbitrary bytes, aligned as the reader expects.
Image copy_of(std::span<const std::byte> bytes);

// Recomputes the checksums of a file whose header and table may be damaged, as far as they lead to
// bytes of the file.
void reseal(std::span<std::byte> bytes);

// Opens with one thread and returns the error, if any. A file that opens is read to its last
// triangle.
std::optional<Error> error_of(std::span<const std::byte> bytes, const char* name = "scene.sobb");

}  // namespace sobb::test
