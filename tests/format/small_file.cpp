// SPDX-License-Identifier: Apache-2.0
#include "format/small_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "format/checksum.h"
#include "format/reader/reader.h"

namespace sobb::test {
namespace {

struct Triangle {
  float vertex[3][3];
};

// Slim triangles on a helix about (1, 2, 3).
Triangle helix_triangle(uint32_t index) {
  Triangle triangle;
  for (int corner = 0; corner < 3; ++corner) {
    const double angle = 0.4 * index + 0.1 * corner;
    triangle.vertex[corner][0] = static_cast<float>(1 + std::cos(angle));
    triangle.vertex[corner][1] = static_cast<float>(2 + std::sin(angle));
    triangle.vertex[corner][2] = static_cast<float>(3 + 0.2 * angle);
  }
  return triangle;
}

// Fills the parts that begin_image() laid out, and the header's fields.
template <int W>
class Filler {
 public:
  Filler(SmallFile& file, std::vector<Triangle> triangles)
      : file_(file), triangles_(std::move(triangles)) {
    file_.fields.triangle_count = triangles_.size();
    fill_record();
    fill_sphere();
  }

  // Child `lane` bounds the triangles [first, end).
  void add_child(int node_index, uint32_t first, uint32_t end, uint16_t basis, uint32_t reference) {
    Node<W>& node = file_.node<W>(node_index);
    const uint32_t lane = child_count(node);
    node.meta[0] =
        static_cast<uint16_t>((node.meta[0] & ~kChildCountMask) | (lane + 1) << kChildCountShift);
    node.reference[lane] = reference;
    node.basis[lane] = basis;
    for (int j = 0; j < 3; ++j) {
      const Direction& n = file_.parts.directions[basis_direction(basis, j)];
      double low = INFINITY;
      double high = -INFINITY;
      for (uint32_t t = first; t < end; ++t) {
        for (const float* p : triangles_[t].vertex) {
          const float* c = file_.fields.centre;
          const double s = double{n.x} * (double{p[0]} - c[0]) +
                           double{n.y} * (double{p[1]} - c[1]) +
                           double{n.z} * (double{p[2]} - c[2]);
          low = std::min(low, s);
          high = std::max(high, s);
        }
      }
      node.slab[j][0][lane] = std::nextafter(static_cast<float>(low), -INFINITY);
      node.slab[j][1][lane] = std::nextafter(static_cast<float>(high), INFINITY);
    }
  }

  // Adds a child that is a leaf; its triangles go to blocks from `block` on.
  void add_leaf(int node_index, uint32_t first, uint32_t end, uint16_t basis, uint32_t block) {
    const uint32_t lane = child_count(file_.node<W>(node_index));
    add_child(node_index, first, end, basis, block);
    file_.node<W>(node_index).meta[lane] |= static_cast<uint16_t>(kLeafBit | (end - first));
    const uint32_t lanes = 4 * static_cast<uint32_t>(blocks_of(end - first));
    for (uint32_t i = 0; i < lanes; ++i) {
      TriangleBlock& to = file_.parts.blocks[block + i / 4];
      to.primitive[i % 4] = first + i < end ? first + i : kNoPrimitive;
      if (first + i >= end) continue;
      for (int corner = 0; corner < 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
          to.vertex[corner][axis][i % 4] = triangles_[first + i].vertex[corner][axis];
        }
      }
    }
    file_.parts.record->reference_count += end - first;
  }

 private:
  void fill_record() {
    BuildRecord& record = *file_.parts.record;
    record.quality = SOBB_QUALITY_MEDIUM;
    record.strategy = SOBB_STRATEGY_K2;
    record.source_hash = 0x0123456789ABCDEF;
    for (int axis = 0; axis < 3; ++axis) {
      record.bounds_min[axis] = INFINITY;
      record.bounds_max[axis] = -INFINITY;
      for (const Triangle& triangle : triangles_) {
        for (const auto& corner : triangle.vertex) {
          record.bounds_min[axis] = std::min(record.bounds_min[axis], corner[axis]);
          record.bounds_max[axis] = std::max(record.bounds_max[axis], corner[axis]);
        }
      }
    }
  }

  // The sphere about the box's centre.
  void fill_sphere() {
    double squares = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = file_.parts.record->bounds_min[axis];
      const float high = file_.parts.record->bounds_max[axis];
      file_.fields.centre[axis] = (low + high) / 2;
      squares += (double{high} - low) * (double{high} - low) / 4;
    }
    file_.fields.radius = std::nextafter(static_cast<float>(std::sqrt(squares)), INFINITY);
  }

  SmallFile& file_;
  std::vector<Triangle> triangles_;
};

SmallFile begin(const Shape& shape, sobb_volume volume, uint32_t depth) {
  SmallFile file;
  file.shape = shape;
  file.image = begin_image(std::make_shared<Memory>(), shape, file.parts);
  file.fields.volume = volume;
  file.fields.depth = depth;
  const std::span<Direction> directions = file.parts.directions;
  directions[0] = {1, 0, 0};
  directions[1] = {0, 1, 0};
  directions[2] = {0, 0, 1};
  for (size_t i = 3; i < directions.size(); ++i) {
    const double angle = 0.1 * static_cast<double>(i);
    directions[i] = {static_cast<float>(0.6 * std::cos(angle)),
                     static_cast<float>(0.6 * std::sin(angle)), 0.8f};
  }
  return file;
}

template <int W>
SmallFile make_small(sobb_volume volume) {
  const bool aabb = volume == SOBB_VOLUME_AABB;
  SmallFile file = begin({W, aabb ? 3u : 16u, 3, 5}, volume, 3);
  std::vector<Triangle> triangles;
  for (uint32_t i = 0; i < 12; ++i) triangles.push_back(helix_triangle(i));
  Filler<W> fill(file, triangles);
  const auto basis = [&](uint32_t a, uint32_t b, uint32_t c) {
    return aabb ? kAxesBasis : make_basis(a, b, c);
  };
  fill.add_child(0, 0, 7, basis(0, 7, 12), 1);
  fill.add_leaf(0, 7, 12, basis(15, 1, 4), 0);
  fill.add_child(1, 0, 6, basis(3, 9, 14), 2);
  fill.add_leaf(1, 6, 7, basis(3, 9, 14), 2);
  fill.add_leaf(2, 0, 4, basis(0, 1, 2), 3);
  fill.add_leaf(2, 4, 6, basis(5, 2, 11), 4);
  file.node<W>(1).meta[0] |= kSharedBit;
  file.seal();
  return file;
}

template <uint32_t W>
SmallFile make_comb_of(uint32_t node_count, uint32_t turn) {
  const uint32_t leaf_count = node_count * (W - 1) + 1;
  SmallFile file = begin({W, 3, node_count, leaf_count}, SOBB_VOLUME_AABB, node_count);
  Filler<W> fill(file, std::vector<Triangle>(leaf_count, helix_triangle(0)));
  uint32_t leaf = 0;
  for (uint32_t i = 0; i < node_count; ++i) {
    const uint32_t inner = i < turn ? 0 : W - 1;
    for (uint32_t lane = 0; lane < W; ++lane) {
      if (lane == inner && i + 1 < node_count) {
        fill.add_child(static_cast<int>(i), 0, 1, kAxesBasis, i + 1);
      } else {
        fill.add_leaf(static_cast<int>(i), leaf, leaf + 1, kAxesBasis, leaf);
        ++leaf;
      }
    }
  }
  file.seal();
  return file;
}

// Reads everything that a traversal might touch, and returns the number of triangles.
template <int W>
uint64_t count_reachable(const FileView& view, uint32_t node_index) {
  const Node<W>& node = view.nodes_of<W>()[node_index];
  uint64_t count = 0;
  for (uint32_t lane = 0; lane < child_count(node); ++lane) {
    for (int j = 0; j < 3; ++j) {
      const Direction& n = view.directions[basis_direction(node.basis[lane], j)];
      EXPECT_TRUE(std::isfinite(n.x * node.slab[j][0][lane] + n.y * node.slab[j][1][lane]));
    }
    if ((node.meta[lane] & kLeafBit) == 0) {
      count += count_reachable<W>(view, node.reference[lane]);
      continue;
    }
    const uint32_t triangles = node.meta[lane] & kTriangleMask;
    for (uint32_t i = 0; i < triangles; ++i) {
      const TriangleBlock& block = view.blocks[node.reference[lane] + i / 4];
      EXPECT_LT(block.primitive[i % 4], view.header->triangle_count);
      EXPECT_TRUE(std::isfinite(block.vertex[2][2][i % 4]));
    }
    count += triangles;
  }
  return count;
}

}  // namespace

FileHeader& SmallFile::header() { return *reinterpret_cast<FileHeader*>(bytes().data()); }

std::span<Section> SmallFile::sections() {
  return {reinterpret_cast<Section*>(bytes().data() + sizeof(FileHeader)), header().section_count};
}

void SmallFile::seal() { finish_image(image, shape, fields, Scheduler(1, nullptr)); }

SmallFile make_small_file(sobb_volume volume, uint32_t width) {
  return width == 4 ? make_small<4>(volume) : make_small<8>(volume);
}

SmallFile make_smallest_file() {
  SmallFile file = begin({4, 3, 1, 1}, SOBB_VOLUME_AABB, 1);
  Filler<4> fill(file, {Triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  fill.add_leaf(0, 0, 1, kAxesBasis, 0);
  file.node<4>(0).meta[0] |= kSharedBit;
  file.seal();
  return file;
}

SmallFile make_chain(uint32_t node_count) {
  SmallFile file = begin({4, 3, node_count, 1}, SOBB_VOLUME_AABB, node_count);
  Filler<4> fill(file, {helix_triangle(0)});
  for (uint32_t i = 0; i + 1 < node_count; ++i) {
    fill.add_child(static_cast<int>(i), 0, 1, kAxesBasis, i + 1);
  }
  fill.add_leaf(static_cast<int>(node_count) - 1, 0, 1, kAxesBasis, 0);
  file.seal();
  return file;
}

SmallFile make_comb(uint32_t width, uint32_t node_count, uint32_t turn) {
  return width == 4 ? make_comb_of<4>(node_count, turn) : make_comb_of<8>(node_count, turn);
}

Image copy_of(std::span<const std::byte> bytes) {
  Image image = Image::allocate(std::make_shared<Memory>(), bytes.size());
  std::ranges::copy(bytes, image.bytes().begin());
  return image;
}

void reseal(std::span<std::byte> bytes) {
  if (bytes.size() < sizeof(FileHeader)) return;
  auto& header = *reinterpret_cast<FileHeader*>(bytes.data());
  const uint64_t room = (bytes.size() - sizeof(FileHeader)) / sizeof(Section);
  if (header.section_count > std::min<uint64_t>(kMaxSections, room)) return;
  const std::span sections(reinterpret_cast<Section*>(bytes.data() + sizeof(FileHeader)),
                           header.section_count);
  for (Section& section : sections) {
    if (section.offset > bytes.size() || section.size > bytes.size() - section.offset) continue;
    section.checksum = section_checksum(bytes.subspan(section.offset, section.size),
                                        Scheduler(1, nullptr), *std::pmr::get_default_resource());
  }
  header.header_checksum = header_checksum(bytes.first(sizeof(FileHeader) + sections.size_bytes()));
}

std::optional<Error> error_of(std::span<const std::byte> bytes, const char* name) {
  try {
    Progress progress(nullptr, nullptr);
    const FileView view =
        read_image(bytes, name, Scheduler(1, nullptr), *std::pmr::get_default_resource(), progress);
    const uint64_t reachable =
        view.header->width == 4 ? count_reachable<4>(view, 0) : count_reachable<8>(view, 0);
    EXPECT_EQ(reachable, view.record->reference_count);
    return std::nullopt;
  } catch (const Error& error) {
    return error;
  }
}

}  // namespace sobb::test
