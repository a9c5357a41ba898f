// SPDX-License-Identifier: Apache-2.0
// Makes the terrain: mountains, a height field of fractal noise.
#include <algorithm>

#include "scene/builtin/scenes.h"

namespace sobb {
namespace {

constexpr double kHalf = 10;

// Blends random values in [-1, 1] at the points of a lattice with a quintic (K. Perlin, Improving
// Noise, 2002).
double noise(double x, double z, uint64_t seed) {
  const double x0 = std::floor(x);
  const double z0 = std::floor(z);
  const auto lattice = [&](int64_t i, int64_t j) {
    const uint64_t key = uint64_t(int64_t(x0) + i) * 0x9E3779B97F4A7C15 +
                         uint64_t(int64_t(z0) + j) * 0xC2B2AE3D27D4EB4F + seed;
    return double(Random::mix_bits(key) >> 11) * 0x1p-52 - 1;
  };
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double u = fade(x - x0);
  const double v = fade(z - z0);
  const double near = lattice(0, 0) + u * (lattice(1, 0) - lattice(0, 0));
  const double far = lattice(0, 1) + u * (lattice(1, 1) - lattice(0, 1));
  return near + v * (far - near);
}

// Sums ridges (1 - |noise|). Coarser ones weight the finer, so that valleys stay smooth (F. K.
// Musgrave, in Texturing and Modeling, 1994).
double height(double x, double z) {
  double sum = 0;
  double weight = 1;
  double amplitude = 1;
  double frequency = 0.16;
  for (uint64_t octave = 0; octave < 12; ++octave) {
    const double value = noise(x * frequency + 31.7, z * frequency - 17.3, octave);
    const double ridge = (1 - std::fabs(value)) * (1 - std::fabs(value));
    sum += amplitude * weight * ridge;
    weight = std::clamp(1.6 * ridge, 0.0, 1.0);
    amplitude *= 0.45;
    // Each octave's lattice is turned a little, so that no two coincide.
    const double turned = 0.8 * x - 0.6 * z;
    z = 0.6 * x + 0.8 * z;
    x = turned;
    frequency *= 2.03;
  }
  return 2.2 * sum - 2.2;
}

}  // namespace

void make_terrain(PartsWriter& parts) {
  // The grid is the one, among the nearly square ones, that spends the most.
  const uint64_t quads = parts.left() / PartsWriter::kQuad;
  const auto root = uint64_t(std::sqrt(double(quads)));
  uint64_t rows = root;
  for (uint64_t i = root; i * 20 > root * 19; --i) {
    if (quads % i < quads % rows) rows = i;
  }
  const uint64_t columns = quads / rows;
  parts.grid(rows, columns, [&](uint64_t i, uint64_t j) {
    const double x = kHalf * (2 * double(j) / double(columns) - 1);
    const double z = kHalf * (2 * double(i) / double(rows) - 1);
    return Vec3{x, height(x, z), z};
  });
}

}  // namespace sobb
