// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cinttypes>
#include <vector>

#include "base/error.h"
#include "format/reader/validate.h"

namespace sobb {
namespace {

constexpr uint64_t kNodesAtOnce = 4096;

// Walks the nodes in the order of the file. References lead forward, so a node's depth is known
// when the walk comes to it, or it has no parent.
template <int W>
class TreeWalk {
 public:
  TreeWalk(const Reading& reading, const FileView& view)
      : reading_(reading),
        view_(view),
        depth_(view.node_count, &reading.scratch),
        block_used_(view.blocks.size(), false, &reading.scratch) {}

  void run() {
    depth_[0] = 1;
    ProgressStage stage(reading_.progress, kNodesEnd, 1, view_.node_count);
    for (uint64_t begin = 0; begin < view_.node_count; begin += kNodesAtOnce) {
      const uint64_t end = std::min(view_.node_count, begin + kNodesAtOnce);
      for (uint64_t i = begin; i < end; ++i) visit(i);
      stage.advance(end - begin);
    }
    const auto unused = std::ranges::find(block_used_, false);
    if (unused != block_used_.end()) {
      fail(SOBB_ERROR_FORMAT_REFERENCE, "%s: triangle block %td is in no leaf", reading_.name,
           unused - block_used_.begin());
    }
    if (deepest_ != view_.header->depth) {
      fail(SOBB_ERROR_FORMAT_DEPTH, "%s: %u nodes deep, the header says %u", reading_.name,
           deepest_, view_.header->depth);
    }
    if (references_ != view_.record->reference_count) {
      fail(SOBB_ERROR_FORMAT_RECORD,
           "%s: build record: reference_count is %" PRIu64 ", leaves have %" PRIu64 " triangles",
           reading_.name, view_.record->reference_count, references_);
    }
  }

 private:
  void visit(uint64_t index) {
    if (depth_[index] == 0) {
      fail(SOBB_ERROR_FORMAT_REFERENCE, "%s: node %" PRIu64 " is no node's child", reading_.name,
           index);
    }
    deepest_ = std::max<uint32_t>(deepest_, depth_[index]);
    const Node<W>& node = view_.nodes_of<W>()[index];
    for (uint32_t lane = 0; lane < child_count(node); ++lane) {
      const uint32_t target = node.reference[lane];
      if ((node.meta[lane] & kLeafBit) != 0) {
        enter_leaf(index, lane, target, node.meta[lane] & kTriangleMask);
      } else {
        enter_child(index, lane, target);
      }
    }
  }

  void enter_child(uint64_t index, uint32_t lane, uint32_t target) {
    if (depth_[target] != 0) {
      fail(SOBB_ERROR_FORMAT_REFERENCE, "%s: node %" PRIu64 ", child %u: node %u has two parents",
           reading_.name, index, lane, target);
    }
    if (depth_[index] == kMaxDepth) {
      fail(SOBB_ERROR_FORMAT_DEPTH, "%s: node %" PRIu64 ", child %u: more than %u nodes deep",
           reading_.name, index, lane, kMaxDepth);
    }
    depth_[target] = static_cast<uint8_t>(depth_[index] + 1);
  }

  void enter_leaf(uint64_t index, uint32_t lane, uint64_t first, uint32_t triangles) {
    for (uint64_t block = first; block < first + blocks_of(triangles); ++block) {
      if (block_used_[block]) {
        fail(SOBB_ERROR_FORMAT_REFERENCE,
             "%s: node %" PRIu64 ", child %u: triangle block %" PRIu64 " is in two leaves",
             reading_.name, index, lane, block);
      }
      block_used_[block] = true;
    }
    references_ += triangles;
  }

  const Reading& reading_;
  const FileView& view_;
  std::pmr::vector<uint8_t> depth_;  // 0: no parent was met yet
  std::pmr::vector<bool> block_used_;
  uint32_t deepest_ = 0;
  uint64_t references_ = 0;
};

}  // namespace

void validate_tree(const Reading& reading, const FileView& view) {
  if (view.header->width == 4) {
    TreeWalk<4>(reading, view).run();
  } else {
    TreeWalk<8>(reading, view).run();
  }
}

}  // namespace sobb
