// SPDX-License-Identifier: Apache-2.0
#include "support/closed_meshes.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace sobb::test {
namespace {

// Makes a sphere of rings and poles about (0.5, 0.5, 0.5). `radius` takes the polar angle and the
// azimuth.
Soup sphere(const char* name, uint32_t rings, uint32_t sides,
            const std::function<double(double, double)>& radius) {
  Soup soup{name, {}, {}};
  const auto add = [&](double polar, double turn) {
    const double r = radius(polar, turn);
    for (const double x :
         {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)}) {
      soup.vertices.push_back(static_cast<float>(0.5 + r * x));
    }
  };
  for (uint32_t ring = 1; ring < rings; ++ring) {
    for (uint32_t side = 0; side < sides; ++side) {
      add(std::numbers::pi * ring / rings, 2 * std::numbers::pi * side / sides);
    }
  }
  add(0, 0);
  add(std::numbers::pi, 0);
  const uint32_t top = (rings - 1) * sides;
  const auto at = [&](uint32_t ring, uint32_t side) {
    if (ring == 0) return top;
    if (ring == rings) return top + 1;
    return (ring - 1) * sides + side % sides;
  };
  for (uint32_t ring = 0; ring < rings; ++ring) {
    for (uint32_t side = 0; side < sides; ++side) {
      const uint32_t a = at(ring, side);
      const uint32_t b = at(ring, side + 1);
      const uint32_t c = at(ring + 1, side);
      const uint32_t d = at(ring + 1, side + 1);
      if (ring > 0) soup.indices.insert(soup.indices.end(), {a, b, d});
      if (ring + 1 < rings) soup.indices.insert(soup.indices.end(), {a, d, c});
    }
  }
  return soup;
}

// Vertices are shared by index, so that they stay closed wherever they are placed.
ClosedMesh placed(const ClosedMesh& mesh, double scale, double offset) {
  const auto at = [&](double value) { return value * scale + offset; };
  return {placed(mesh.soup, scale, offset),
          {at(mesh.centre[0]), at(mesh.centre[1]), at(mesh.centre[2])},
          mesh.radius * scale};
}

}  // namespace

std::vector<ClosedMesh> closed_meshes() {
  const auto round = [](double, double) { return 0.5; };
  const auto spiky = [](double polar, double turn) {
    return 0.35 + 0.15 * std::cos(17 * polar) * std::sin(19 * turn);
  };
  const ClosedMesh box = {closed_box(16), {0.5, 0.5, 0.5}, 0.4999};
  const ClosedMesh ball = {sphere("sphere", 40, 60, round), {0.5, 0.5, 0.5}, 0.49};
  const ClosedMesh slivers = {sphere("slivers", 9, 1500, round), {0.5, 0.5, 0.5}, 0.45};
  const ClosedMesh spikes = {sphere("spikes", 60, 90, spiky), {0.5, 0.5, 0.5}, 0.18};
  return {box, ball, slivers, spikes, placed(ball, 1, 1e4), placed(slivers, 1e-12, 0)};
}

std::vector<sobb_ray> rays_from_inside(const ClosedMesh& mesh, uint64_t seed, size_t count) {
  Random random(seed);
  const auto triangles = static_cast<uint32_t>(mesh.soup.indices.size() / 3);
  std::vector<sobb_ray> rays(count);
  for (sobb_ray& ray : rays) {
    double away[3];
    do {
      for (double& value : away) value = 2 * random.uniform() - 1;
    } while (away[0] * away[0] + away[1] * away[1] + away[2] * away[2] > 1);
    const uint32_t triangle = random.below(triangles);
    const uint32_t kind = random.below(3);
    const double s = kind == 1 ? random.uniform() : 0;
    bool zero = true;
    for (int k = 0; k < 3; ++k) {
      ray.origin[k] = static_cast<float>(mesh.centre[k] + mesh.radius * away[k]);
      const double a = mesh.soup.corner(triangle, 0)[k];
      const double b = mesh.soup.corner(triangle, 1)[k];
      const double target =
          kind == 2 ? mesh.centre[k] + mesh.radius * (6 * random.uniform() - 3) : a + s * (b - a);
      ray.direction[k] = static_cast<float>(target - ray.origin[k]);
      zero = zero && ray.direction[k] == 0;
    }
    if (zero) ray.direction[0] = 1;
    ray.tmin = 0;
    ray.tmax = std::numeric_limits<float>::infinity();
  }
  return rays;
}

}  // namespace sobb::test
