// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cinttypes>

#include "base/error.h"
#include "format/reader/validate.h"

namespace sobb {
namespace {

constexpr uint64_t kBlocksAtOnce = 4096;

void validate_block(const TriangleBlock& block, uint64_t index, const Reading& reading,
                    uint64_t triangle_count) {
  const uint32_t used = used_lanes(block);
  const auto refuse = [&](int lane, const char* cause, double value) {
    fail(SOBB_ERROR_FORMAT_TRIANGLE, "%s: triangle block %" PRIu64 ", lane %d: %s (%g)",
         reading.name, index, lane, cause, value);
  };
  for (int lane = 0; lane < 4; ++lane) {
    const uint32_t primitive = block.primitive[lane];
    const bool padding = static_cast<uint32_t>(lane) >= used;
    if (padding != (primitive == kNoPrimitive)) {
      refuse(lane, padding ? "used after an unused lane" : "unused before a used lane", primitive);
    }
    if (!padding && primitive >= triangle_count) refuse(lane, "no such primitive", primitive);
    for (const auto& corner : block.vertex) {
      for (const auto& axis : corner) {
        const float coordinate = axis[lane];
        if (padding && std::bit_cast<uint32_t>(coordinate) != 0) {
          refuse(lane, "unused, but not zero", coordinate);
        }
        if (!within(coordinate, kMaxCoordinate)) {
          refuse(lane, "coordinate is not finite or beyond 2^60", coordinate);
        }
      }
    }
  }
  if (used == 0) {
    fail(SOBB_ERROR_FORMAT_TRIANGLE, "%s: triangle block %" PRIu64 " is empty", reading.name,
         index);
  }
}

}  // namespace

void validate_blocks(const Reading& reading, const FileView& view) {
  const uint64_t triangle_count = view.header->triangle_count;
  ProgressStage stage(reading.progress, kChecksumsEnd, kBlocksEnd, view.blocks.size());
  reading.scheduler.for_ranges(view.blocks.size(), kBlocksAtOnce,
                               [&](uint64_t begin, uint64_t end) {
                                 for (uint64_t i = begin; i < end; ++i) {
                                   validate_block(view.blocks[i], i, reading, triangle_count);
                                 }
                                 stage.advance(end - begin);
                               });
}

}  // namespace sobb
