// SPDX-License-Identifier: Apache-2.0
// How weight is spread over directions, and where it has its peaks. A direction and its opposite
// are one: slabs do not tell them apart.
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

  // The heaviest peaks, at most `limit`, heaviest first; of those nearer to each other than
  // kPeakSpacing the heavier one. Every share is `least_share` or more. In the histogram's memory.
  std::pmr::vector<DirectionPeak> peaks(uint32_t limit, double least_share) const;

  // The eigenvectors of the sum of w n n^T: where no single direction stands out, these still turn
  // with the scene.
  OrthogonalFrame principal_axes() const;

 private:
  // A cell has about 1.4 degrees across. Half the octahedron's faces, unfolded to a square.
  static constexpr uint32_t kSide = 64;
  static constexpr uint32_t kCells = kSide * kSide;

  // Lengths and vectors, summed; of the two opposites the upper one.
  struct Cell {
    double weight = 0;
    Vector sum = {0, 0, 0};
  };

  std::pmr::vector<Cell> cells_;
};

}  // namespace sobb
