// SPDX-License-Identifier: Apache-2.0
#include "volumes/shared_topology.h"

#include <chrono>
#include <utility>

#include "base/error.h"
#include "builder/volumes/node_writer.h"

namespace sobb::study {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Calls visit(references, first block) for every leaf of a part.
template <class Visit>
void for_leaves(const Treelet& part, const References& references, const Visit& visit) {
  for (const WideNode& node : part.nodes) {
    for (uint32_t i = 0; i < node.child_count; ++i) {
      if (!node.is_leaf(i)) continue;
      visit(references.part(node.first[i], node.count[i]), node.index[i]);
    }
  }
}

std::unique_ptr<SharedTopology::Layout> make_layout(const Mesh& mesh, const Topology& topology,
                                                    uint32_t width, const Scheduler& scheduler,
                                                    const std::shared_ptr<Memory>& memory) {
  const auto start = Clock::now();
  auto layout =
      std::make_unique<SharedTopology::Layout>(collapse(topology, width, scheduler, *memory));
  layout->block_bytes = Image::allocate(memory, layout->wide.block_count * sizeof(TriangleBlock));
  auto* blocks = reinterpret_cast<TriangleBlock*>(layout->block_bytes.bytes().data());
  const auto write = [&](const Treelet& part) {
    for_leaves(part, layout->wide.references, [&](const References& leaf, uint32_t block) {
      write_blocks(mesh, leaf.primitives, blocks + block);
    });
  };
  scheduler.for_each(layout->wide.subtrees.size(),
                     [&](uint64_t i) { write(layout->wide.subtrees[i]); });
  write(layout->wide.top);
  layout->ms = ms_since(start);
  return layout;
}

uint64_t count_leaves(const WideTopology& wide) {
  uint64_t count = 0;
  const auto add = [&](const References&, uint32_t) { ++count; };
  for_leaves(wide.top, wide.references, add);
  for (const Treelet& part : wide.subtrees) for_leaves(part, wide.references, add);
  return count;
}

}  // namespace

SharedTopology::SharedTopology(const sobb_triangles& triangles, const Scheduler& scheduler,
                               std::shared_ptr<Memory> memory)
    : memory_(std::move(memory)),
      mesh_(triangles, scheduler),
      summary_(summarise(mesh_, scheduler, *memory_)) {
  Progress progress(nullptr, nullptr);
  const auto start = Clock::now();
  topology_ = std::make_unique<Topology>(mesh_, SOBB_QUALITY_MEDIUM, scheduler, *memory_, progress,
                                         /*progress_end=*/1);
  topology_ms_ = ms_since(start);
  binary_ = make_layout(mesh_, *topology_, 2, scheduler, memory_);
  eight_wide_ = make_layout(mesh_, *topology_, 8, scheduler, memory_);
  leaf_count_ = count_leaves(binary_->wide);
}

const SharedTopology::Layout& SharedTopology::layout(uint32_t width) const {
  if (width != 2 && width != 8) {
    fail(SOBB_ERROR_INVALID_ARGUMENT, "a layout of width %u; there are 2 and 8", width);
  }
  return width == 2 ? *binary_ : *eight_wide_;
}

}  // namespace sobb::study
