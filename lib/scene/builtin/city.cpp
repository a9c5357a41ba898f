// SPDX-License-Identifier: Apache-2.0
// Makes the city: buildings in rows, all of boxes along the axes, with windows and boxes on roofs.
#include <algorithm>

#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr double kHalf = 10;  // of the plane

struct Block {
  Vec3 low;
  Vec3 high;
};

// Writes window frames that stand out of the four walls, `columns` by `floors` on each.
void write_windows(PartsWriter& parts, const Block& block, uint64_t columns, uint64_t floors) {
  const Vec3 size = block.high - block.low;
  const double rise = size.y / double(floors);
  for (uint64_t floor = 0; floor < floors; ++floor) {
    const double y0 = block.low.y + rise * (double(floor) + 0.25);
    const double y1 = y0 + 0.5 * rise;
    for (uint64_t column = 0; column < columns; ++column) {
      const double from = (double(column) + 0.22) / double(columns);
      const double to = (double(column) + 0.78) / double(columns);
      const double out = 0.012 * (size.x + size.z);
      const double x0 = block.low.x + from * size.x;
      const double x1 = block.low.x + to * size.x;
      const double z0 = block.low.z + from * size.z;
      const double z1 = block.low.z + to * size.z;
      parts.box({x0, y0, block.low.z - out}, {x1, y1, block.low.z + out});
      parts.box({x0, y0, block.high.z - out}, {x1, y1, block.high.z + out});
      parts.box({block.low.x - out, y0, z0}, {block.low.x + out, y1, z1});
      parts.box({block.high.x - out, y0, z0}, {block.high.x + out, y1, z1});
    }
  }
}

void write_roof(PartsWriter& parts, Random& random, const Block& block, uint64_t boxes) {
  const Vec3 size = block.high - block.low;
  const double least = std::min(size.x, size.z);
  for (uint64_t i = 0; i < boxes; ++i) {
    const Vec3 half = 0.5 * least * Vec3{random.uniform(0.05, 0.2), 0, random.uniform(0.05, 0.2)};
    const Vec3 at{random.uniform(block.low.x + half.x, block.high.x - half.x), block.high.y,
                  random.uniform(block.low.z + half.z, block.high.z - half.z)};
    const Vec3 rise{0, least * random.uniform(0.05, 0.25), 0};
    parts.box(at - half, at + half + rise);
  }
}

// Spends `boxes` boxes on a tower of one to three storeys set back, its windows and its roof.
void write_building(PartsWriter& parts, Random& random, Vec3 middle, double half, double height,
                    uint64_t boxes) {
  const uint64_t tiers = boxes < 10 ? 1 : 1 + random.below(3);
  Block block{middle - Vec3{half * random.uniform(0.75, 1.0), 0, half * random.uniform(0.75, 1.0)},
              {}};
  block.high = 2.0 * middle - block.low;
  const uint64_t roof = std::min<uint64_t>(boxes / 8, 12);
  uint64_t windows = boxes - std::min(boxes, tiers + roof);
  for (uint64_t tier = 0; tier < tiers; ++tier) {
    block.high.y = block.low.y + height * (tier == 0 ? 0.6 : 0.4) / double(tier == 0 ? 1 : tiers);
    parts.box(block.low, block.high);
    --boxes;
    // The windows are as square as the walls let them be.
    const uint64_t share = windows / (tiers - tier) / 4;
    const double slender = (block.high.y - block.low.y) / (block.high.x - block.low.x);
    const auto floors = std::max<uint64_t>(1, uint64_t(std::sqrt(double(share) * slender)));
    const uint64_t columns = share / floors;
    write_windows(parts, block, columns, floors);
    windows -= 4 * floors * columns;
    boxes -= 4 * floors * columns;
    if (tier + 1 == tiers) break;
    const Vec3 inset = 0.12 * (block.high - block.low);
    block.low = {block.low.x + inset.x, block.high.y, block.low.z + inset.z};
    block.high = block.high - Vec3{inset.x, 0, inset.z};
  }
  write_roof(parts, random, block, boxes);
}

}  // namespace

void make_city(PartsWriter& parts) {
  parts.quad({-kHalf, 0, -kHalf}, {-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf});
  // With more triangles there are more buildings, and each has more windows.
  uint64_t rows = 1;
  while (rows * rows * rows < parts.left() / 70) ++rows;
  Random random(5);
  const double pitch = 2 * kHalf / double(rows);
  for (uint64_t i = 0; i < rows * rows; ++i) {
    const uint64_t row = i / rows;
    const Vec3 middle{-kHalf + pitch * (double(i % rows) + 0.5), 0,
                      -kHalf + pitch * (double(row) + 0.5)};
    const double far = length(middle) / kHalf;  // towers in the middle, houses at the edge
    const double height =
        std::min(pitch, 3.0) * random.uniform(0.5, 1.6) * (0.6 + 1.8 / (1 + 4 * far * far));
    const uint64_t boxes = parts.left() / PartsWriter::kBox / (rows * rows - i);
    if (boxes > 0) write_building(parts, random, middle, 0.36 * pitch, height, boxes);
  }
}

}  // namespace sobb
