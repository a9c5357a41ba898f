// SPDX-License-Identifier: Apache-2.0
// Seeded triangles and rays for property tests, from harmless to hostile.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "sobb/sobb.h"

namespace sobb::test {

// Uniform numbers from a seed. (std::mt19937 is the same everywhere; its distributions are not.)
class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}

  uint64_t bits() { return engine_(); }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(bits() % count); }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  float between(double low, double high) {
    return static_cast<float>(low + (high - low) * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

struct Soup {
  std::string name;
  std::vector<float> vertices;
  std::vector<uint32_t> indices;

  sobb_triangles view() const {
    return {sizeof(sobb_triangles), 0, vertices.data(), vertices.size() / 3, 0, indices.data(),
            indices.size() / 3};
  }
  const float* corner(uint64_t triangle, int i) const {
    return &vertices[3 * indices[3 * triangle + i]];
  }
  void add(const float a[3], const float b[3], const float c[3]) {
    for (const float* corner : {a, b, c}) {
      indices.push_back(static_cast<uint32_t>(vertices.size() / 3));
      vertices.insert(vertices.end(), corner, corner + 3);
    }
  }
};

// Small triangles of every orientation in a unit cube.
Soup random_soup(uint64_t seed, uint32_t triangles, double size = 0.1);
// Needles and slivers, one dimension a thousand to a million times another.
Soup sliver_soup(uint64_t seed, uint32_t triangles);
// A closed grid-faced box: shared vertices and edges, axis-aligned faces.
Soup closed_box(uint32_t cells);
// Closed boxes along a frame of their own, which is turned against the axes. A few are large and go
// through the others, so that spatial splits have something to cut.
Soup turned_boxes(uint64_t seed, uint32_t boxes);
// Doubled, coplanar, degenerate and point-like triangles.
Soup degenerate_soup(uint64_t seed, uint32_t triangles);
// The triangles of `soup` times `scale`, moved by `offset` along (1, 1, 1).
Soup placed(Soup soup, double scale, double offset);
// One triangle, many times.
Soup identical_soup(uint32_t triangles);

// A third of the rays through the soup's box at random, a third at vertices and along edges, a
// third with special directions: axes, zeros of both signs, the table's normals, tiny and huge.
std::vector<sobb_ray> mixed_rays(const Soup& soup, uint64_t seed, uint32_t count);

}  // namespace sobb::test
