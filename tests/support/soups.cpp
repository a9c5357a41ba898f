// SPDX-License-Identifier: Apache-2.0
#include "support/soups.h"

#include <algorithm>

namespace sobb::test {
namespace {

void random_point(Random& random, float point[3]) {
  for (int k = 0; k < 3; ++k) point[k] = random.between(0, 1);
}

struct Extent {
  float lower[3];
  float upper[3];
};

Extent extent_of(const Soup& soup) {
  Extent extent;
  for (int k = 0; k < 3; ++k) {
    extent.lower[k] = extent.upper[k] = soup.corner(0, 0)[k];
    for (uint64_t t = 0; t < soup.indices.size() / 3; ++t) {
      for (int i = 0; i < 3; ++i) {
        extent.lower[k] = std::min(extent.lower[k], soup.corner(t, i)[k]);
        extent.upper[k] = std::max(extent.upper[k], soup.corner(t, i)[k]);
      }
    }
  }
  return extent;
}

// Anywhere in the box, or up to its size outside of it.
void point_about(Random& random, const Extent& extent, float point[3]) {
  for (int k = 0; k < 3; ++k) {
    const double size = static_cast<double>(extent.upper[k]) - extent.lower[k];
    point[k] = random.between(extent.lower[k] - size, extent.upper[k] + size);
  }
}

// A vertex, or a point of an edge or of the inside, as floats come.
void point_of_triangle(Random& random, const Soup& soup, float point[3]) {
  const uint64_t triangle = random.below(static_cast<uint32_t>(soup.indices.size() / 3));
  double weight[3] = {1, 0, 0};
  const uint32_t kind = random.below(3);
  if (kind > 0) {
    weight[1] = random.uniform();
    weight[2] = kind == 2 ? random.uniform() : 0;
  }
  const double sum = weight[0] + weight[1] + weight[2];
  for (int k = 0; k < 3; ++k) {
    double value = 0;
    for (int i = 0; i < 3; ++i) value += weight[i] / sum * soup.corner(triangle, i)[k];
    point[k] = static_cast<float>(value);
  }
}

void special_direction(Random& random, float direction[3]) {
  static constexpr float kValues[] = {0.0F, -0.0F, 1.0F, -1.0F, 1e-30F, -1e-30F, 0x1p-140F, 1e30F};
  do {
    for (int k = 0; k < 3; ++k) direction[k] = kValues[random.below(std::size(kValues))];
  } while (direction[0] == 0 && direction[1] == 0 && direction[2] == 0);
}

// In the plane of a triangle, or along one of its edges.
void grazing_direction(Random& random, const Soup& soup, float origin[3], float direction[3]) {
  const uint64_t triangle = random.below(static_cast<uint32_t>(soup.indices.size() / 3));
  const float* a = soup.corner(triangle, 0);
  const float* b = soup.corner(triangle, 1);
  const float* c = soup.corner(triangle, 2);
  const double s = random.below(2) == 0 ? 0 : random.uniform();
  for (int k = 0; k < 3; ++k) {
    direction[k] = static_cast<float>((b[k] - a[k]) + s * (c[k] - a[k]));
    origin[k] = a[k] - 2 * direction[k];
  }
}

}  // namespace

Soup random_soup(uint64_t seed, uint32_t triangles, double size) {
  Random random(seed);
  Soup soup{"random", {}, {}};
  for (uint32_t t = 0; t < triangles; ++t) {
    float corner[3][3];
    random_point(random, corner[0]);
    for (int i = 1; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) corner[i][k] = corner[0][k] + random.between(-size, size);
    }
    soup.add(corner[0], corner[1], corner[2]);
  }
  return soup;
}

Soup sliver_soup(uint64_t seed, uint32_t triangles) {
  Random random(seed);
  Soup soup{"slivers", {}, {}};
  for (uint32_t t = 0; t < triangles; ++t) {
    float a[3];
    float b[3];
    float c[3];
    random_point(random, a);
    random_point(random, b);
    const double thin = random.below(2) == 0 ? 1e-3 : 1e-6;
    for (int k = 0; k < 3; ++k) c[k] = b[k] + random.between(-thin, thin);
    soup.add(a, b, c);
  }
  return soup;
}

Soup closed_box(uint32_t cells) {
  Soup soup{"closed box", {}, {}};
  const auto at = [&](uint32_t i) { return static_cast<float>(i) / static_cast<float>(cells); };
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t side = 0; side < 2; ++side) {
      for (uint32_t i = 0; i < cells; ++i) {
        for (uint32_t j = 0; j < cells; ++j) {
          float corner[4][3];
          for (uint32_t n = 0; n < 4; ++n) {
            corner[n][axis] = static_cast<float>(side);
            corner[n][(axis + 1) % 3] = at(i + (n & 1));
            corner[n][(axis + 2) % 3] = at(j + (n >> 1));
          }
          soup.add(corner[0], corner[1], corner[3]);
          soup.add(corner[0], corner[3], corner[2]);
        }
      }
    }
  }
  return soup;
}

Soup turned_boxes(uint64_t seed, uint32_t boxes) {
  constexpr double kFrame[3][3] = {
      {2 / 3.0, -1 / 3.0, 2 / 3.0}, {2 / 3.0, 2 / 3.0, -1 / 3.0}, {-1 / 3.0, 2 / 3.0, 2 / 3.0}};
  Random random(seed);
  const Soup unit = closed_box(1);
  Soup soup{"turned boxes", {}, {}};
  for (uint32_t i = 0; i < boxes; ++i) {
    const double largest = i % 16 == 0 ? 1 : 0.1;
    double low[3];
    double size[3];
    for (int k = 0; k < 3; ++k) {
      low[k] = random.uniform();
      size[k] = largest * random.uniform();
    }
    for (uint64_t t = 0; t < unit.indices.size() / 3; ++t) {
      float corner[3][3];
      for (int c = 0; c < 3; ++c) {
        double at[3];
        for (int k = 0; k < 3; ++k) at[k] = low[k] + size[k] * unit.corner(t, c)[k];
        for (int k = 0; k < 3; ++k) {
          corner[c][k] = static_cast<float>(kFrame[0][k] * at[0] + kFrame[1][k] * at[1] +
                                            kFrame[2][k] * at[2]);
        }
      }
      soup.add(corner[0], corner[1], corner[2]);
    }
  }
  return soup;
}

Soup degenerate_soup(uint64_t seed, uint32_t triangles) {
  Random random(seed);
  Soup soup{"degenerate", {}, {}};
  while (soup.indices.size() < 3 * size_t{triangles}) {
    float a[3];
    float b[3];
    float c[3];
    random_point(random, a);
    random_point(random, b);
    random_point(random, c);
    switch (random.below(4)) {
      case 0:  // doubled, the second turned round
        soup.add(a, b, c);
        soup.add(c, b, a);
        break;
      case 1:  // a point
        soup.add(a, a, a);
        break;
      case 2:  // a line
        soup.add(a, b, a);
        break;
      default:  // two in one plane that overlap
        c[2] = b[2] = a[2];
        soup.add(a, b, c);
        for (int k = 0; k < 2; ++k) a[k] += 0.1F;
        soup.add(a, b, c);
    }
  }
  return soup;
}

Soup placed(Soup soup, double scale, double offset) {
  for (float& value : soup.vertices) value = static_cast<float>(value * scale + offset);
  soup.name += " * " + std::to_string(scale) + " + " + std::to_string(offset);
  return soup;
}

Soup identical_soup(uint32_t triangles) {
  Soup soup{"identical", {0, 0, 0, 1, 0, 0, 0, 1, 0}, {}};
  for (uint32_t t = 0; t < triangles; ++t) soup.indices.insert(soup.indices.end(), {0, 1, 2});
  return soup;
}

std::vector<sobb_ray> mixed_rays(const Soup& soup, uint64_t seed, uint32_t count) {
  Random random(seed);
  const Extent extent = extent_of(soup);
  std::vector<sobb_ray> rays(count);
  for (sobb_ray& ray : rays) {
    float target[3];
    point_about(random, extent, ray.origin);
    ray.tmin = 0;
    ray.tmax = std::numeric_limits<float>::infinity();
    switch (random.below(4)) {
      case 0:
        point_about(random, extent, target);
        for (int k = 0; k < 3; ++k) ray.direction[k] = target[k] - ray.origin[k];
        break;
      case 1:
        point_of_triangle(random, soup, target);
        for (int k = 0; k < 3; ++k) ray.direction[k] = target[k] - ray.origin[k];
        ray.tmax = random.below(2) == 0 ? 1.0F : ray.tmax;
        break;
      case 2:
        grazing_direction(random, soup, ray.origin, ray.direction);
        break;
      default:
        point_of_triangle(random, soup, ray.origin);
        special_direction(random, ray.direction);
        if (random.below(2) == 0) {
          const float back = random.between(0, 2);
          for (int k = 0; k < 3; ++k) {
            const float step = back * ray.direction[k];
            if (std::fabs(step) < 1e6F) ray.origin[k] -= step;
          }
        }
    }
    if (random.below(8) == 0) ray.tmin = random.between(0, 0.5);
  }
  return rays;
}

}  // namespace sobb::test
