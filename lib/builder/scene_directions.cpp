// SPDX-License-Identifier: Apache-2.0
#include "builder/scene_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "bounds/directions/fitted_directions.h"

namespace sobb {
namespace {

// A sample of this size tells a scene's directions as well as ten million triangles.
constexpr uint64_t kMostSamples = 1 << 14;
// Each range of samples has its own sums, which are added up in order: the result depends on the
// ranges, not on the threads.
constexpr uint64_t kGrain = 1 << 11;

// A peak has at least this share of all area or length: 16 times the share that it would have if
// directions were spread evenly.
constexpr double kLeastShare = 0.01;
constexpr uint32_t kMostNormals = 16;
constexpr uint32_t kMostEdges = 6;
constexpr uint32_t kMostPeaks = std::max(kMostNormals, kMostEdges);
// Cosines of the ever narrower cones, of 0.36 and 0.036 degrees, within which a peak's mean is
// taken again: directions near a peak must not draw it off the plane that many walls share.
constexpr double kConeCosines[] = {0.99998, 0.9999998};
// A frame replaces the axes if the boxes of single triangles along it are on average at most this
// wide, relative to those along the axes. A hierarchy's gain follows that ratio: it is 0.64 on
// pipes and 0.73 on a town that are turned, where a ray then tests half as many triangles; above
// 0.98 nothing is gained.
constexpr double kLeastGain = 0.98;

// Triangles of a mesh, evenly spread over it: a random one of each `stride` consecutive ones, since
// meshes repeat themselves (12 triangles per box, 2 per quad).
class Sample {
 public:
  explicit Sample(const Mesh& mesh)
      : mesh_(mesh), stride_((mesh.triangle_count() + kMostSamples - 1) / kMostSamples) {}

  uint64_t size() const { return mesh_.triangle_count() / stride_; }
  uint64_t ranges() const { return (size() + kGrain - 1) / kGrain; }

  // The triangle's edges, which sum up to zero.
  void edges(uint64_t i, Vector edge[3]) const {
    const uint64_t triangle = i * stride_ + scatter(i) % stride_;
    const Point p[3] = {mesh_.corner(triangle, 0), mesh_.corner(triangle, 1),
                        mesh_.corner(triangle, 2)};
    for (int j = 0; j < 3; ++j) {
      const Point a = p[j];
      const Point b = p[(j + 1) % 3];
      edge[j] = {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y,
                 static_cast<double>(b.z) - a.z};
    }
  }

 private:
  // The output function of SplitMix64 (G. Steele et al., "Fast Splittable Pseudorandom Number
  // Generators", 2014).
  static uint64_t scatter(uint64_t i) {
    uint64_t z = (i + 1) * 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

  const Mesh& mesh_;
  uint64_t stride_;
};

struct Histograms {
  DirectionHistogram normals;
  DirectionHistogram edges;

  explicit Histograms(std::pmr::memory_resource& memory) : normals(memory), edges(memory) {}
};

Histograms histograms_of(const Sample& sample, const Scheduler& scheduler,
                         std::pmr::memory_resource& memory) {
  std::pmr::vector<Histograms> ranges(&memory);
  ranges.reserve(sample.ranges());
  // Made one by one: a copy would use the default memory resource.
  for (uint64_t i = 0; i < sample.ranges(); ++i) ranges.emplace_back(memory);
  scheduler.for_ranges(sample.size(), kGrain, [&](uint64_t begin, uint64_t end) {
    Histograms& range = ranges[begin / kGrain];
    for (uint64_t i = begin; i < end; ++i) {
      Vector edge[3];
      sample.edges(i, edge);
      range.normals.add(cross(edge[0], edge[1]));
      for (const Vector& e : edge) range.edges.add(e);
    }
  });
  for (size_t i = 1; i < ranges.size(); ++i) {
    ranges[0].normals.add(ranges[i].normals);
    ranges[0].edges.add(ranges[i].edges);
  }
  return std::move(ranges[0]);
}

// Adds up the vectors that lie in a cone about each peak.
class Cones {
 public:
  Cones(std::span<const DirectionPeak> peaks, double cosine) : peaks_(peaks), cosine_(cosine) {}

  void add(const Vector& v) {
    const double least = cosine_ * length(v);
    for (size_t j = 0; j < peaks_.size(); ++j) {
      const double along = dot(v, peaks_[j].direction);
      if (std::fabs(along) < least) continue;
      for (size_t k = 0; k < 3; ++k) sums_[j][k] += along < 0 ? -v[k] : v[k];
    }
  }
  void add(const Cones& other) {
    for (size_t j = 0; j < peaks_.size(); ++j) {
      for (size_t k = 0; k < 3; ++k) sums_[j][k] += other.sums_[j][k];
    }
  }
  // Moves each peak to the mean direction in its cone; a peak whose cone is empty stays.
  void move(std::pmr::vector<DirectionPeak>& peaks) const {
    for (size_t j = 0; j < peaks.size(); ++j) {
      const double norm = length(sums_[j]);
      if (norm > 0) {
        for (size_t k = 0; k < 3; ++k) peaks[j].direction[k] = sums_[j][k] / norm;
      }
    }
  }

 private:
  std::span<const DirectionPeak> peaks_;
  double cosine_;
  std::array<Vector, kMostPeaks> sums_{};
};

void refine(const Sample& sample, double cosine, const Scheduler& scheduler,
            std::pmr::memory_resource& memory, std::pmr::vector<DirectionPeak>& normals,
            std::pmr::vector<DirectionPeak>& edges) {
  std::pmr::vector<Cones> of_normals(sample.ranges(), Cones(normals, cosine), &memory);
  std::pmr::vector<Cones> of_edges(sample.ranges(), Cones(edges, cosine), &memory);
  scheduler.for_ranges(sample.size(), kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) {
      Vector edge[3];
      sample.edges(i, edge);
      of_normals[begin / kGrain].add(cross(edge[0], edge[1]));
      for (const Vector& e : edge) of_edges[begin / kGrain].add(e);
    }
  });
  for (size_t i = 1; i < sample.ranges(); ++i) {
    of_normals[0].add(of_normals[i]);
    of_edges[0].add(of_edges[i]);
  }
  of_normals[0].move(normals);
  of_edges[0].move(edges);
}

// Half the surface area of a triangle's box along a frame.
double box_area(const OrthogonalFrame& frame, const Vector edge[3]) {
  double d[3];
  for (int k = 0; k < 3; ++k) {
    // The longest of the three edges' extents, which is half of their sum.
    d[k] = (std::fabs(dot(edge[0], frame.axis[k])) + std::fabs(dot(edge[1], frame.axis[k])) +
            std::fabs(dot(edge[2], frame.axis[k]))) /
           2;
  }
  return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
}

// Finds the frame in which the boxes of single triangles are smallest; the first frame, the axes,
// if the gain is small. The roots of areas are summed up: by areas a few large triangles would
// decide.
size_t best_frame(const Sample& sample, const Scheduler& scheduler,
                  std::span<const OrthogonalFrame> frames, std::pmr::memory_resource& memory) {
  using Areas = std::array<double, kMostFrames>;
  std::pmr::vector<Areas> ranges(sample.ranges(), Areas{}, &memory);
  scheduler.for_ranges(sample.size(), kGrain, [&](uint64_t begin, uint64_t end) {
    for (uint64_t i = begin; i < end; ++i) {
      Vector edge[3];
      sample.edges(i, edge);
      for (size_t j = 0; j < frames.size(); ++j) {
        ranges[begin / kGrain][j] += std::sqrt(box_area(frames[j], edge));
      }
    }
  });
  Areas total{};
  for (const Areas& range : ranges) {
    for (size_t j = 0; j < frames.size(); ++j) total[j] += range[j];
  }
  const auto best = std::min_element(total.begin(), total.begin() + frames.size());
  return *best < kLeastGain * total[0] ? static_cast<size_t>(best - total.begin()) : 0;
}

}  // namespace

DirectionSet scene_directions(const Mesh& mesh, uint32_t k, const Scheduler& scheduler,
                              std::pmr::memory_resource& memory) {
  const Sample sample(mesh);
  const Histograms histograms = histograms_of(sample, scheduler, memory);
  std::pmr::vector<DirectionPeak> normals = histograms.normals.peaks(kMostNormals, kLeastShare);
  std::pmr::vector<DirectionPeak> edges = histograms.edges.peaks(kMostEdges, kLeastShare);
  for (const double cosine : kConeCosines)
    refine(sample, cosine, scheduler, memory, normals, edges);
  const OrthogonalFrame principal[] = {histograms.normals.principal_axes(),
                                       histograms.edges.principal_axes()};
  const auto frames = candidate_frames(normals, edges, principal, memory);
  const size_t best = best_frame(sample, scheduler, frames, memory);
  if (best == 0) return default_direction_set(k, memory);
  return {turned_directions(k, frames[best], memory), SOBB_TABLE_FITTED};
}

}  // namespace sobb
