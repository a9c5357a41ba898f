// SPDX-License-Identifier: Apache-2.0
#include "capi/random_bases.h"
#include "base/xxh3.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "format/layout.h"

namespace sobb::test {
namespace {

// What bounds a subtree along every direction of the table, rounded outwards.
struct Extent {
  float lower[kMaxDirections];
  float upper[kMaxDirections];

  Extent() {
    std::fill(std::begin(lower), std::end(lower), INFINITY);
    std::fill(std::begin(upper), std::end(upper), -INFINITY);
  }
  void merge(const Extent& other) {
    for (uint32_t k = 0; k < kMaxDirections; ++k) {
      lower[k] = std::min(lower[k], other.lower[k]);
      upper[k] = std::max(upper[k], other.upper[k]);
    }
  }
};

// Rewrites a copy of a file.
class Rewriter {
 public:
  Rewriter(std::string bytes, uint64_t seed) : bytes_(std::move(bytes)), random_(seed) {}

  std::string rewrite() {
    if (header().width == 4) {
      bound<4>(0);
    } else {
      bound<8>(0);
    }
    seal();
    return bytes_;
  }

 private:
  template <class T>
  T* at(uint64_t offset) {
    return reinterpret_cast<T*>(&bytes_[offset]);
  }
  FileHeader& header() { return *at<FileHeader>(0); }
  Section& section(uint32_t index) { return at<Section>(sizeof(FileHeader))[index]; }
  template <class T>
  T* section_of(SectionId id) {
    uint32_t index = 0;
    while (section(index).id != static_cast<uint32_t>(id)) ++index;
    return at<T>(section(index).offset);
  }

  template <int W>
  Extent bound(uint32_t index) {
    Node<W>& node = section_of<Node<W>>(SectionId::kNodes)[index];
    const bool own = random_.below(2) == 0;
    const uint16_t shared = random_.below(2) == 0 ? kAxesBasis : random_basis();
    Extent all;
    for (uint32_t i = 0; i < child_count(node); ++i) {
      const bool leaf = (node.meta[i] & kLeafBit) != 0;
      const Extent extent = leaf ? bound_leaf(node.reference[i], node.meta[i] & kTriangleMask)
                                 : bound<W>(node.reference[i]);
      all.merge(extent);
      node.basis[i] = own ? random_basis() : shared;
      for (int j = 0; j < 3; ++j) {
        const uint32_t k = basis_direction(node.basis[i], j);
        node.slab[j][0][i] = extent.lower[k];
        node.slab[j][1][i] = extent.upper[k];
      }
    }
    node.meta[0] = static_cast<uint16_t>((node.meta[0] & ~kSharedBit) | (own ? 0 : kSharedBit));
    return all;
  }

  Extent bound_leaf(uint32_t block, uint32_t triangles) {
    const auto* blocks = section_of<TriangleBlock>(SectionId::kBlocks) + block;
    const auto* directions = section_of<Direction>(SectionId::kDirections);
    Extent extent;
    for (uint32_t i = 0; i < triangles; ++i) {
      for (const auto& vertex : blocks[i / 4].vertex) {
        for (uint32_t k = 0; k < header().direction_count; ++k) {
          const Direction& n = directions[k];
          const float along[3] = {n.x, n.y, n.z};
          double s = 0;
          for (int axis = 0; axis < 3; ++axis) {
            s += double{along[axis]} * (double{vertex[axis][i % 4]} - header().centre[axis]);
          }
          const auto rounded = static_cast<float>(s);
          extent.lower[k] = std::min(extent.lower[k], std::nextafter(rounded, -INFINITY));
          extent.upper[k] = std::max(extent.upper[k], std::nextafter(rounded, INFINITY));
        }
      }
    }
    return extent;
  }

  // Three different directions.
  uint16_t random_basis() {
    const uint32_t count = header().direction_count;
    const uint32_t a = random_.below(count);
    const uint32_t b = (a + 1 + random_.below(count - 1)) % count;
    uint32_t c = a;
    while (c == a || c == b) c = random_.below(count);
    return make_basis(a, b, c);
  }

  void seal() {
    constexpr uint64_t kPiece = uint64_t{1} << 20;
    for (uint32_t i = 0; i < header().section_count; ++i) {
      Section& s = section(i);
      std::vector<uint64_t> pieces;
      for (uint64_t done = 0; done < s.size; done += kPiece) {
        pieces.push_back(XXH3_64bits(&bytes_[s.offset + done], std::min(kPiece, s.size - done)));
      }
      s.checksum = XXH3_64bits(pieces.data(), pieces.size() * sizeof pieces[0]);
    }
    header().header_checksum = 0;
    header().header_checksum =
        XXH3_64bits(bytes_.data(), sizeof(FileHeader) + header().section_count * sizeof(Section));
  }

  std::string bytes_;
  Random random_;
};

}  // namespace

HierarchyHandle with_random_bases(const HierarchyHandle& hierarchy, uint64_t seed) {
  const std::string bytes = Rewriter(bytes_of(hierarchy), seed).rewrite();
  sobb_hierarchy* rebound = nullptr;
  EXPECT_EQ(sobb_open_memory(bytes.data(), bytes.size(), nullptr, &rebound), SOBB_OK)
      << sobb_last_error();
  return HierarchyHandle(rebound);
}

}  // namespace sobb::test
