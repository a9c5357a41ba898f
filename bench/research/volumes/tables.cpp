// SPDX-License-Identifier: Apache-2.0
#include "volumes/tables.h"

#include <algorithm>

namespace sobb::study {
namespace {

// The axes and the four diagonals of a cube.
constexpr float kThird = 0.57735026F;  // 1 / sqrt 3
constexpr Direction kDop14[] = {{1, 0, 0},
                                {0, 1, 0},
                                {0, 0, 1},
                                {kThird, kThird, kThird},
                                {-kThird, kThird, kThird},
                                {kThird, -kThird, kThird},
                                {-kThird, -kThird, kThird}};

std::pmr::vector<DirectionTable> cut_into_tables(std::span<const Direction> directions,
                                                 std::pmr::memory_resource& memory) {
  std::pmr::vector<DirectionTable> chunks(&memory);
  for (size_t first = 0; first < directions.size(); first += kMaxDirections) {
    const size_t count = std::min<size_t>(kMaxDirections, directions.size() - first);
    chunks.push_back(make_direction_table(directions.subspan(first, count)));
  }
  return chunks;
}

}  // namespace

std::span<const Direction> directions_of(const Method& method) {
  switch (method.volume) {
    case VolumeKind::kObb:
      return {};
    case VolumeKind::kDop14:
      return kDop14;
    default:
      return default_directions(method.k);
  }
}

Tables::Tables(const Method& method, sobb_strategy strategy, const BoundsKernels& kernels,
               const MeshSummary& summary, std::pmr::memory_resource& memory)
    : directions(directions_of(method)),
      chunks(cut_into_tables(directions, memory)),
      bases(method.has_strategy() ? directions : std::span<const Direction>(), memory),
      kernels(kernels),
      strategy(strategy),
      centre{summary.centre.x, summary.centre.y, summary.centre.z},
      radius(summary.radius),
      scale(radius > 0 ? 1 / radius : 1) {}

}  // namespace sobb::study
