// SPDX-License-Identifier: Apache-2.0
#include "bounds/directions/direction_histogram.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace sobb {
namespace {

// Cosines of the angle that a peak's weight lies within, 2 degrees, and of the least angle between
// two peaks, 4 degrees.
constexpr double kPeakCosine = 0.9994;
constexpr double kSpacingCosine = 0.9976;
// A peak on a corner of cells is spread over several of them, at most this many.
constexpr double kCellsOfPeak = 8;

// The weight of a cell that no peak has taken yet.
struct Remainder {
  Vector direction;
  double weight;
};

// Finds the mean direction of the weight around `start`, and that weight.
Remainder gather(std::span<const Remainder> rests, const Vector& start) {
  Remainder sum{{0, 0, 0}, 0};
  for (const Remainder& rest : rests) {
    const double cosine = dot(rest.direction, start);
    if (std::fabs(cosine) < kPeakCosine) continue;
    const double weight = cosine < 0 ? -rest.weight : rest.weight;
    for (int k = 0; k < 3; ++k) sum.direction[k] += weight * rest.direction[k];
    sum.weight += rest.weight;
  }
  const double norm = length(sum.direction);
  for (double& component : sum.direction) component /= norm;
  return sum;
}

}  // namespace

void DirectionHistogram::add(const Vector& v) {
  const double weight = length(v);
  if (weight == 0) return;
  // The octahedron |x| + |y| + |z| = 1 seen from above is a square on its corner.
  const double sign = v[2] < 0 ? -1 : 1;
  const double scale = sign / (std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]));
  const auto cell_of = [&](double coordinate) {  // from -1 to 1
    return std::min(static_cast<uint32_t>((coordinate + 1) * (0.5 * kSide)), kSide - 1);
  };
  Cell& cell = cells_[cell_of(scale * (v[0] + v[1])) * kSide + cell_of(scale * (v[0] - v[1]))];
  cell.weight += weight;
  for (int k = 0; k < 3; ++k) cell.sum[k] += sign * v[k];
}

void DirectionHistogram::add(const DirectionHistogram& other) {
  for (uint32_t i = 0; i < kCells; ++i) {
    cells_[i].weight += other.cells_[i].weight;
    for (int k = 0; k < 3; ++k) cells_[i].sum[k] += other.cells_[i].sum[k];
  }
}

std::pmr::vector<DirectionPeak> DirectionHistogram::peaks(uint32_t limit,
                                                          double least_share) const {
  std::pmr::vector<Remainder> rests(cells_.get_allocator());
  double total = 0;
  for (const Cell& cell : cells_) {
    const double norm = length(cell.sum);
    if (norm == 0) continue;
    rests.push_back({{cell.sum[0] / norm, cell.sum[1] / norm, cell.sum[2] / norm}, cell.weight});
    total += cell.weight;
  }
  const auto heavier = [](const DirectionPeak& a, const DirectionPeak& b) {
    return a.share > b.share;
  };
  std::pmr::vector<DirectionPeak> peaks(cells_.get_allocator());
  for (;;) {
    const auto heaviest = std::max_element(
        rests.begin(), rests.end(),
        [](const Remainder& a, const Remainder& b) { return a.weight < b.weight; });
    if (heaviest == rests.end() || heaviest->weight * kCellsOfPeak < least_share * total) break;
    const Remainder peak = gather(rests, gather(rests, heaviest->direction).direction);
    if (peak.weight >= least_share * total) {
      const DirectionPeak found = {peak.direction, peak.weight / total};
      peaks.insert(std::upper_bound(peaks.begin(), peaks.end(), found, heavier), found);
    }
    heaviest->weight = 0;  // so that the loop ends, wherever the mean lies
    for (Remainder& rest : rests) {
      if (std::fabs(dot(rest.direction, peak.direction)) > kSpacingCosine) rest.weight = 0;
    }
  }
  if (peaks.size() > limit) peaks.resize(limit);
  return peaks;
}

OrthogonalFrame DirectionHistogram::principal_axes() const {
  Vector tensor[3] = {};
  for (const Cell& cell : cells_) {
    const double norm = length(cell.sum);
    if (norm == 0) continue;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) tensor[i][j] += cell.sum[i] / norm * cell.sum[j];
    }
  }
  return sobb::principal_axes(tensor);
}

}  // namespace sobb
