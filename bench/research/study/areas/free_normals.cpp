// SPDX-License-Identifier: Apache-2.0
#include "study/areas/free_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bounds/area.h"
#include "bounds/basis_table.h"

namespace sobb::study {
namespace {

constexpr int kDimensions = 6;  // two per normal
constexpr int kRandomStarts = 4;
constexpr int kMostSteps = 300;
constexpr double kSteps[] = {0.25, 0.05,
                             0.01};  // size of the first simplex of each search, in radians
constexpr double kTolerance = 1e-5;

using Offsets = std::array<double, kDimensions>;

Direction unit(const Vector& v) {
  const double norm = length(v);
  return {static_cast<float>(v[0] / norm), static_cast<float>(v[1] / norm),
          static_cast<float>(v[2] / norm)};
}

// Coordinates of normals near some others: offsets along two tangents of each.
class Chart {
 public:
  explicit Chart(const Normals& origin) {
    for (size_t j = 0; j < 3; ++j) {
      normal_[j] = {origin[j].x, origin[j].y, origin[j].z};
      const auto smallest =
          std::min_element(normal_[j].begin(), normal_[j].end(),
                           [](double a, double b) { return std::fabs(a) < std::fabs(b); });
      Vector away{};
      away[static_cast<size_t>(smallest - normal_[j].begin())] = 1;
      const Direction first = unit(cross(normal_[j], away));
      tangent_[2 * j] = {first.x, first.y, first.z};
      tangent_[2 * j + 1] = cross(normal_[j], tangent_[2 * j]);
    }
  }

  Normals at(const Offsets& offset) const {
    Normals normals;
    for (size_t j = 0; j < 3; ++j) {
      Vector v = normal_[j];
      for (size_t k = 0; k < 3; ++k) {
        v[k] += offset[2 * j] * tangent_[2 * j][k] + offset[2 * j + 1] * tangent_[2 * j + 1][k];
      }
      normals[j] = unit(v);
    }
    return normals;
  }

 private:
  std::array<Vector, 3> normal_;
  std::array<Vector, kDimensions> tangent_;
};

struct Corner {
  Offsets offset;
  double area;
};

// a + s (b - a)
Offsets between(const Offsets& a, const Offsets& b, double s) {
  Offsets result;
  for (size_t k = 0; k < kDimensions; ++k) result[k] = a[k] + s * (b[k] - a[k]);
  return result;
}

// J. Nelder, R. Mead, "A Simplex Method for Function Minimization" (1965).
Normals descend(const PointSet& points, const Normals& start, double step) {
  const Chart chart(start);
  const auto corner = [&](const Offsets& offset) {
    return Corner{offset, area_with(points, chart.at(offset))};
  };
  std::array<Corner, kDimensions + 1> simplex;
  for (size_t i = 0; i <= kDimensions; ++i) {
    Offsets offset{};
    if (i > 0) offset[i - 1] = step;
    simplex[i] = corner(offset);
  }
  const auto less = [](const Corner& a, const Corner& b) { return a.area < b.area; };
  for (int i = 0; i < kMostSteps; ++i) {
    std::sort(simplex.begin(), simplex.end(), less);
    Corner& worst = simplex.back();
    if (!(worst.area > simplex.front().area * (1 + kTolerance))) break;
    Offsets centre{};
    for (size_t j = 0; j < kDimensions; ++j) {
      for (size_t k = 0; k < kDimensions; ++k) centre[k] += simplex[j].offset[k] / kDimensions;
    }
    const Corner reflected = corner(between(centre, worst.offset, -1));
    if (reflected.area < simplex.front().area) {
      const Corner expanded = corner(between(centre, worst.offset, -2));
      worst = std::min(expanded, reflected, less);
    } else if (reflected.area < simplex[kDimensions - 1].area) {
      worst = reflected;
    } else {
      const bool outside = reflected.area < worst.area;
      const Corner contracted = corner(between(centre, worst.offset, outside ? -0.5 : 0.5));
      if (contracted.area < std::min(reflected.area, worst.area)) {
        worst = contracted;
      } else {
        for (size_t j = 1; j <= kDimensions; ++j) {
          simplex[j] = corner(between(simplex[0].offset, simplex[j].offset, 0.5));
        }
      }
    }
  }
  return chart.at(std::min_element(simplex.begin(), simplex.end(), less)->offset);
}

// Three directions uniform over the sphere.
Normals random_normals(std::mt19937& random) {
  Normals normals;
  for (Direction& normal : normals) {
    Vector v;
    double square = 0;
    do {
      square = 0;
      for (double& component : v) {
        component = static_cast<double>(random()) * 0x1p-31 - 1;
        square += component * component;
      }
    } while (square > 1 || square < 0x1p-20);
    normal = unit(v);
  }
  return normals;
}

}  // namespace

double area_with(const PointSet& points, const Normals& normals) {
  if (std::fabs(determinant(normals[0], normals[1], normals[2])) < kSmallestDeterminant) {
    return std::numeric_limits<double>::infinity();
  }
  const double width[3] = {points.width(normals[0]), points.width(normals[1]),
                           points.width(normals[2])};
  return slab_area(normals.data(), width);
}

double optimise_normals(const PointSet& points, std::span<const Normals> starts) {
  std::mt19937 random;  // its first seed is the standard's
  double least = std::numeric_limits<double>::infinity();
  const auto search = [&](Normals normals) {
    for (const double step : kSteps) normals = descend(points, normals, step);
    least = std::min(least, area_with(points, normals));
  };
  for (const Normals& start : starts) search(start);
  for (int i = 0; i < kRandomStarts; ++i) search(random_normals(random));
  return least;
}

}  // namespace sobb::study
