// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/morton_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "builder/array.h"
#include "builder/boxes/box.h"

namespace sobb {
namespace {

// Each range of triangles counts those of each cell. More ranges would take more memory.
constexpr uint64_t kLeastGrain = 1 << 13;
constexpr uint64_t kMostRanges = 16;
// The grid is the coarsest whose cells have this many triangles or fewer on average.
constexpr uint64_t kTrianglesPerCell = 512;
constexpr uint32_t kMostBits = kMostCellLevels / 3;  // of a coordinate

// Spreads the bits of a coordinate to every third bit.
constexpr auto make_spread() {
  std::array<uint16_t, 1 << kMostBits> spread{};
  for (uint32_t i = 0; i < spread.size(); ++i) {
    for (uint32_t bit = 0; bit < kMostBits; ++bit) {
      spread[i] = static_cast<uint16_t>(spread[i] | (i >> bit & 1) << 3 * bit);
    }
  }
  return spread;
}
constexpr auto kSpread = make_spread();

// Twice the centre of a box, along one axis.
float centre_of(const Box& box, int axis) { return box.lower[axis] + box.upper[axis]; }

struct CentreBounds {
  float lower[3] = {kNone, kNone, kNone};
  float upper[3] = {-kNone, -kNone, -kNone};

  static constexpr float kNone = std::numeric_limits<float>::infinity();

  void grow(int axis, float least, float greatest) {
    lower[axis] = std::min(lower[axis], least);
    upper[axis] = std::max(upper[axis], greatest);
  }
};

class Grid {
 public:
  Grid(const CentreBounds& bounds, uint64_t triangle_count) {
    while (bits_ < kMostBits && (kTrianglesPerCell << 3 * bits_) < triangle_count) ++bits_;
    const float side = static_cast<float>(1 << bits_);
    last_ = side - 1;
    for (int k = 0; k < 3; ++k) {
      const float scale = side / (bounds.upper[k] - bounds.lower[k]);
      lower_[k] = bounds.lower[k];
      scale_[k] = std::isfinite(scale) ? scale : 0;
    }
  }

  uint64_t cell_count() const { return uint64_t{1} << 3 * bits_; }

  uint32_t cell_of(const Box& box) const {
    uint32_t cell = 0;
    for (int k = 0; k < 3; ++k) {
      const float at = std::min((centre_of(box, k) - lower_[k]) * scale_[k], last_);
      cell |= uint32_t{kSpread[static_cast<uint32_t>(at)]} << k;
    }
    return cell;
  }

 private:
  uint32_t bits_ = 1;
  float last_;  // the last cell along an axis
  float lower_[3];
  float scale_[3];
};

CentreBounds bounds_of(const Mesh& mesh, const Frame& frame, std::span<const uint32_t> triangles,
                       uint64_t grain, const Scheduler& scheduler,
                       std::pmr::memory_resource& memory) {
  std::pmr::vector<CentreBounds> ranges((triangles.size() + grain - 1) / grain, &memory);
  scheduler.for_ranges(triangles.size(), grain, [&](uint64_t begin, uint64_t end) {
    CentreBounds own;
    for (uint64_t i = begin; i < end; ++i) {
      const Box box = box_of(mesh, triangles[i], frame);
      for (int k = 0; k < 3; ++k) own.grow(k, centre_of(box, k), centre_of(box, k));
    }
    ranges[begin / grain] = own;
  });
  CentreBounds all;
  for (const CentreBounds& range : ranges) {
    for (int k = 0; k < 3; ++k) all.grow(k, range.lower[k], range.upper[k]);
  }
  return all;
}

// Turns the number of triangles that each range has of each cell into the place of the first.
MortonCells place_ranges(std::span<uint32_t> counts, uint64_t cell_count,
                         std::pmr::memory_resource& memory) {
  MortonCells cells{std::pmr::vector<uint64_t>(cell_count + 1, &memory)};
  uint64_t place = 0;
  for (uint64_t cell = 0; cell < cell_count; ++cell) {
    cells.begin[cell] = place;
    for (uint64_t i = cell; i < counts.size(); i += cell_count) {
      const uint32_t count = counts[i];
      counts[i] = static_cast<uint32_t>(place);
      place += count;
    }
  }
  cells.begin[cell_count] = place;
  return cells;
}

}  // namespace

bool MortonCells::is_one() const {
  const auto last = std::lower_bound(begin.begin(), begin.end(), triangle_count());
  return *(last - 1) == 0;
}

MortonCells sort_into_cells(const Mesh& mesh, const Frame& frame, std::span<uint32_t> triangles,
                            const Scheduler& scheduler, std::pmr::memory_resource& memory) {
  const uint64_t count = triangles.size();
  const uint64_t grain = std::max(kLeastGrain, (count + kMostRanges - 1) / kMostRanges);
  const Grid grid(bounds_of(mesh, frame, triangles, grain, scheduler, memory), count);
  const uint64_t cell_count = grid.cell_count();
  Array<uint16_t> cell_of(count, memory);
  Array<uint32_t> unsorted(count, memory);
  std::pmr::vector<uint32_t> places((count + grain - 1) / grain * cell_count, &memory);
  scheduler.for_ranges(count, grain, [&](uint64_t begin, uint64_t end) {
    uint32_t* const counts = &places[begin / grain * cell_count];
    for (uint64_t i = begin; i < end; ++i) {
      const uint32_t cell = grid.cell_of(box_of(mesh, triangles[i], frame));
      ++counts[cell];
      cell_of[i] = static_cast<uint16_t>(cell);
      unsorted[i] = triangles[i];
    }
  });
  MortonCells cells = place_ranges(places, cell_count, memory);
  scheduler.for_ranges(count, grain, [&](uint64_t begin, uint64_t end) {
    uint32_t* const place = &places[begin / grain * cell_count];
    for (uint64_t i = begin; i < end; ++i) triangles[place[cell_of[i]]++] = unsorted[i];
  });
  return cells;
}

}  // namespace sobb
