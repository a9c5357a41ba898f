// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>

#include "base/error.h"
#include "format/reader/validate.h"

namespace sobb {
namespace {

constexpr uint64_t kNodesAtOnce = 1024;

// One child of a node, that is a lane of it, with what messages name.
template <int W>
class Child {
 public:
  Child(const Reading& reading, const FileView& view, uint64_t node_index, int lane)
      : reading_(reading),
        view_(view),
        node_(view.nodes_of<W>()[node_index]),
        node_index_(node_index),
        lane_(lane) {}

  void validate() const {
    validate_meta();
    validate_slabs();
    validate_basis();
    if (is_leaf()) {
      validate_leaf();
    } else {
      validate_reference();
    }
  }

  // Proves that all bits of an unused lane are zero.
  void validate_unused() const {
    uint32_t bits = node_.reference[lane_] | node_.basis[lane_] | node_.meta[lane_];
    for (const auto& slab : node_.slab) {
      for (const auto& plane : slab) bits |= std::bit_cast<uint32_t>(plane[lane_]);
    }
    if (bits != 0) refuse(SOBB_ERROR_FORMAT_NODE, "unused, but not zero");
  }

 private:
  bool is_leaf() const { return (node_.meta[lane_] & kLeafBit) != 0; }
  uint32_t triangles() const { return node_.meta[lane_] & kTriangleMask; }

  void validate_meta() const {
    const uint32_t of_node = lane_ == 0 ? kChildCountMask | kSharedBit : 0;
    const uint32_t undefined = ~(kLeafBit | kTriangleMask | of_node) & 0xFFFF;
    if ((node_.meta[lane_] & undefined) != 0) {
      refuse(SOBB_ERROR_FORMAT_NODE, "undefined bits in meta word 0x%04X", node_.meta[lane_]);
    }
    if (is_leaf() != (triangles() != 0)) {
      refuse(SOBB_ERROR_FORMAT_NODE, "%s of %u triangles", is_leaf() ? "leaf" : "inner child",
             triangles());
    }
  }

  void validate_slabs() const {
    for (int j = 0; j < 3; ++j) {
      const float low = node_.slab[j][0][lane_];
      const float high = node_.slab[j][1][lane_];
      if (!within(low, kMaxExtent) || !within(high, kMaxExtent)) {
        refuse(SOBB_ERROR_FORMAT_NODE, "slab %d [%g, %g] is not finite or beyond 2^62", j, low,
               high);
      }
      if (low > high) {
        refuse(SOBB_ERROR_FORMAT_NODE, "slab %d has min %g > max %g", j, low, high);
      }
    }
  }

  void validate_basis() const {
    const uint32_t basis = node_.basis[lane_];
    const uint32_t a = basis_direction(basis, 0);
    const uint32_t b = basis_direction(basis, 1);
    const uint32_t c = basis_direction(basis, 2);
    const bool possible = basis >> 15 == 0 && std::max({a, b, c}) < view_.directions.size() &&
                          a != b && b != c && c != a;
    if (!possible) {
      refuse(SOBB_ERROR_FORMAT_NODE, "basis 0x%04X is not three of %zu directions", basis,
             view_.directions.size());
    }
    if (view_.header->volume == SOBB_VOLUME_AABB && basis != kAxesBasis) {
      refuse(SOBB_ERROR_FORMAT_NODE, "basis 0x%04X of an AABB is not the axes", basis);
    }
    if ((node_.meta[0] & kSharedBit) != 0 && basis != node_.basis[0]) {
      refuse(SOBB_ERROR_FORMAT_NODE, "basis 0x%04X differs from the shared one, 0x%04X", basis,
             node_.basis[0]);
    }
  }

  // References lead forward only, so that there is no cycle, and one pass meets parents before
  // their children.
  void validate_reference() const {
    const uint64_t target = node_.reference[lane_];
    if (target >= view_.node_count) {
      refuse(SOBB_ERROR_FORMAT_REFERENCE, "node %" PRIu64 " of %" PRIu64, target, view_.node_count);
    }
    if (target <= node_index_) {
      refuse(SOBB_ERROR_FORMAT_REFERENCE, "refers back, to node %" PRIu64, target);
    }
  }

  void validate_leaf() const {
    const uint64_t first = node_.reference[lane_];
    const uint64_t count = blocks_of(triangles());
    if (first + count > view_.blocks.size()) {
      refuse(SOBB_ERROR_FORMAT_REFERENCE, "triangle blocks %" PRIu64 " to %" PRIu64 " of %zu",
             first, first + count - 1, view_.blocks.size());
    }
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t due = std::min(4u, triangles() - 4 * i);
      const uint32_t used = used_lanes(view_.blocks[first + i]);
      if (used != due) {
        refuse(SOBB_ERROR_FORMAT_TRIANGLE,
               "leaf of %u triangles, but triangle block %" PRIu64 " has %u, not %u", triangles(),
               first + i, used, due);
      }
    }
  }

  [[noreturn]] __attribute__((format(printf, 3, 4))) void refuse(sobb_status status,
                                                                 const char* format, ...) const {
    char cause[128];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(cause, sizeof cause, format, arguments);
    va_end(arguments);
    fail(status, "%s: node %" PRIu64 ", child %d: %s", reading_.name, node_index_, lane_, cause);
  }

  const Reading& reading_;
  const FileView& view_;
  const Node<W>& node_;
  uint64_t node_index_;
  int lane_;
};

template <int W>
void validate_node(const Reading& reading, const FileView& view, uint64_t index) {
  const uint32_t count = child_count(view.nodes_of<W>()[index]);
  if (count < 1 || count > W) {
    fail(SOBB_ERROR_FORMAT_NODE, "%s: node %" PRIu64 ": %u children, not 1 to %d", reading.name,
         index, count, W);
  }
  for (int lane = 0; lane < W; ++lane) {
    const Child<W> child(reading, view, index, lane);
    if (static_cast<uint32_t>(lane) < count) {
      child.validate();
    } else {
      child.validate_unused();
    }
  }
}

}  // namespace

void validate_nodes(const Reading& reading, const FileView& view) {
  const auto validate = view.header->width == 4 ? validate_node<4> : validate_node<8>;
  ProgressStage stage(reading.progress, kBlocksEnd, kNodesEnd, view.node_count);
  reading.scheduler.for_ranges(view.node_count, kNodesAtOnce, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) validate(reading, view, i);
    stage.advance(end - begin);
  });
}

}  // namespace sobb
