// SPDX-License-Identifier: Apache-2.0
// A histogram of directions by weight, and its peaks. A direction and its opposite are one: slabs
// do not tell them apart.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "bounds/directions/principal_axes.h"

namespace sobb {

// A direction around which weight lies close.
struct DirectionPeak {
  Vector direction;  // of length 1
  double share;      // of the whole weight, 0 to 1
};

class DirectionHistogram {
 public:
  explicit DirectionHistogram(std::pmr::memory_resource& memory) : cells_(kCells, &memory) {}

  // Adds a direction with its length as the weight.
  void add(const Vector& v);
  void add(const DirectionHistogram& other);

  // Finds at most `limit` peaks, heaviest first, each with a share of at least `least_share`. Of
  // peaks nearer to each other than the spacing (4 degrees) only the heavier one counts. The peaks
  // are in the histogram's memory.
  std::pmr::vector<DirectionPeak> peaks(uint32_t limit, double least_share) const;

  // The eigenvectors of the sum of w n n^T. Where no single direction stands out, they still turn
  // with the scene.
  OrthogonalFrame principal_axes() const;

 private:
  // Cells are squares on half the octahedron's faces, unfolded; each is about 1.4 degrees wide.
  static constexpr uint32_t kSide = 64;
  static constexpr uint32_t kCells = kSide * kSide;

  // The sums of lengths and of vectors, each vector turned upward.
  struct Cell {
    double weight = 0;
    Vector sum = {0, 0, 0};
  };

  std::pmr::vector<Cell> cells_;
};

}  // namespace sobb
