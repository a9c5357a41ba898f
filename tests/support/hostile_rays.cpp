// SPDX-License-Identifier: Apache-2.0
#include "support/hostile_rays.h"

#include <algorithm>
#include <cmath>

namespace sobb::test {
namespace {

using Vec = std::array<double, 3>;
using Normals = std::span<const std::array<float, 3>>;

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec& a) { return std::sqrt(dot(a, a)); }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec any_direction(Random& random) {
  for (;;) {
    const Vec v = {2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
    if (const double l = length(v); l > 0.1) return 1 / l * v;
  }
}

struct Triangle {
  Vec corner[3];

  Triangle(const Soup& soup, uint64_t index) {
    for (int i = 0; i < 3; ++i) {
      const float* at = soup.corner(index, i);
      corner[i] = {at[0], at[1], at[2]};
    }
  }
  // A point of the edge that begins at a corner.
  Vec edge_point(int i, double s) const {
    return corner[i] + s * (corner[(i + 1) % 3] - corner[i]);
  }
  double size() const {
    return std::max(length(corner[1] - corner[0]), length(corner[2] - corner[0]));
  }
};

sobb_ray ray_of(const Vec& origin, const Vec& direction) {
  sobb_ray ray = {{}, 0, {}, std::numeric_limits<float>::infinity()};
  bool nothing = true;
  for (int k = 0; k < 3; ++k) {
    ray.origin[k] = static_cast<float>(origin[k]);
    ray.direction[k] = static_cast<float>(direction[k]);
    nothing = nothing && ray.direction[k] == 0;
  }
  if (nothing) ray.direction[2] = 1;
  return ray;
}

// From a point a while before `target`, with the direction that floats have between both.
sobb_ray ray_through(const Vec& target, const Vec& direction, double distance) {
  const sobb_ray from = ray_of(target - distance * direction, direction);
  const Vec origin = {from.origin[0], from.origin[1], from.origin[2]};
  return ray_of(origin, target - origin);
}

// Something small beside 1: zero, or some ulps of a float.
double few_ulps(Random& random) {
  return (static_cast<double>(random.below(9)) - 4) * 0x1p-24 * (random.below(2) == 0 ? 1 : 0.1);
}

class Maker {
 public:
  Maker(const Soup& soup, Normals normals, uint64_t seed)
      : soup_(soup), normals_(normals), random_(seed) {
    Vec low = Triangle(soup, 0).corner[0];
    Vec high = low;
    for (uint64_t t = 0; t < soup.indices.size() / 3; ++t) {
      for (const Vec& corner : Triangle(soup, t).corner) {
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], corner[k]);
          high[k] = std::max(high[k], corner[k]);
        }
      }
    }
    size_ = length(high - low);
  }

  sobb_ray make(RayFamily family) {
    const Triangle triangle(soup_, random_.below(static_cast<uint32_t>(soup_.indices.size() / 3)));
    const auto i = static_cast<int>(random_.below(3));
    switch (family) {
      case RayFamily::kVertices:
        return ray_through(triangle.corner[i], any_direction(random_), about_size());
      case RayFamily::kEdges:
        return at_edge(triangle, i);
      case RayFamily::kInPlane:
        return in_plane(triangle);
      case RayFamily::kAlongSlab:
        return along_slab(triangle.edge_point(i, random_.uniform()));
      case RayFamily::kAcrossSlab: {
        const Vec direction = table_normal();
        return ray_of(triangle.edge_point(i, random_.uniform()) - about_size() * direction,
                      direction);
      }
      case RayFamily::kZeros:
        return with_zeros(triangle.edge_point(i, random_.uniform()));
      case RayFamily::kFromPoint:
      case RayFamily::kToPoint:
        return of_bundle(family == RayFamily::kToPoint);
      case RayFamily::kDistant:
        break;
    }
    const double away = size_ * std::pow(10, 12 * random_.uniform() - 6);
    return ray_through(triangle.edge_point(i, random_.below(2) * random_.uniform()),
                       any_direction(random_), away);
  }

 private:
  double about_size() { return size_ * (0.01 + 2 * random_.uniform()); }

  Vec table_normal() {
    const auto& n = normals_[random_.below(static_cast<uint32_t>(normals_.size()))];
    const double sign = random_.below(2) == 0 ? 1 : -1;
    return {sign * n[0], sign * n[1], sign * n[2]};
  }

  sobb_ray at_edge(const Triangle& triangle, int i) {
    if (random_.below(2) == 0) {
      return ray_through(triangle.edge_point(i, random_.uniform()), any_direction(random_),
                         about_size());
    }
    const Vec edge = triangle.edge_point(i, 1) - triangle.corner[i];
    return ray_of(triangle.corner[i] - 2 * random_.uniform() * edge, edge);
  }

  sobb_ray in_plane(const Triangle& triangle) {
    const Vec a = triangle.corner[1] - triangle.corner[0];
    const Vec b = triangle.corner[2] - triangle.corner[0];
    const Vec direction = (2 * random_.uniform() - 1) * a + (2 * random_.uniform() - 1) * b;
    const Vec inside = triangle.corner[0] + 0.5 * random_.uniform() * (a + b);
    return ray_of(inside - 3 * random_.uniform() * direction, direction);
  }

  sobb_ray along_slab(const Vec& target) {
    const Vec normal = table_normal();
    Vec direction = cross(normal, any_direction(random_));
    direction = 1 / length(direction) * direction + few_ulps(random_) * normal;
    return ray_of(target - about_size() * direction, direction);
  }

  sobb_ray with_zeros(const Vec& target) {
    static constexpr double kValues[] = {0.0,      -0.0,      1,     -1,   0x1p-149, -0x1p-149,
                                         0x1p-127, -0x1p-100, 1e-20, 1e20, 0.3,      -0x1p-24};
    Vec direction;
    for (double& value : direction) value = kValues[random_.below(std::size(kValues))];
    // Before the target where that is in floats' range and near it.
    const double l = length(direction);
    const double back = l == 0 ? 0 : about_size() / l;
    sobb_ray ray = ray_of(target - back * direction, direction);
    for (int k = 0; k < 3; ++k) {
      if (random_.below(8) == 0) ray.origin[k] = random_.below(2) == 0 ? 0.0F : -0.0F;
    }
    return ray;
  }

  // The next ray between a point and places about a vertex.
  sobb_ray of_bundle(bool to_point) {
    if (bundled_++ % 64 == 0) {
      const Triangle triangle(soup_,
                              random_.below(static_cast<uint32_t>(soup_.indices.size() / 3)));
      target_ = triangle.corner[random_.below(3)];
      const sobb_ray from = ray_of(target_ - about_size() * any_direction(random_), {});
      point_ = {from.origin[0], from.origin[1], from.origin[2]};
      static constexpr double kLengths[] = {1, 1, 0x1p-30, 0x1p40, 0x1p90, 0x1p-100};
      length_ = kLengths[random_.below(std::size(kLengths))];
    }
    const double width = random_.below(4) == 0 ? 0 : 0.01 * length(target_ - point_);
    const Vec target = target_ + width * random_.uniform() * any_direction(random_);
    if (!to_point) return ray_of(point_, length_ * (target - point_));
    const sobb_ray from = ray_of(target, {});
    const Vec origin = {from.origin[0], from.origin[1], from.origin[2]};
    sobb_ray ray = ray_of(origin, length_ * (point_ - origin));
    ray.tmax = static_cast<float>(1 / length_);
    return ray;
  }

  const Soup& soup_;
  Normals normals_;
  Random random_;
  double size_;
  // State of the bundle that next rays belong to.
  uint32_t bundled_ = 0;
  Vec target_;
  Vec point_;
  double length_ = 1;
};

}  // namespace

std::vector<sobb_ray> hostile_rays(const Soup& soup, RayFamily family, Normals normals,
                                   uint64_t seed, uint32_t count) {
  Maker maker(soup, normals, seed);
  std::vector<sobb_ray> rays(count);
  for (sobb_ray& ray : rays) ray = maker.make(family);
  return rays;
}

}  // namespace sobb::test
