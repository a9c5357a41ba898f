// SPDX-License-Identifier: Apache-2.0
#include "build/clip.h"

#include <cfloat>
#include <cmath>

namespace sobb {
namespace {

// Rounding of a cut in double, relative to the largest coordinate, with room to spare.
constexpr double kCutError = 0x1p-48;

float below_of(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded <= value ? rounded : std::nextafter(rounded, -FLT_MAX);
}

float above_of(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded >= value ? rounded : std::nextafter(rounded, FLT_MAX);
}

double largest_coordinate(const Corners& triangle) {
  double largest = 0;
  for (const auto& corner : triangle.at) {
    for (const float coordinate : corner) {
      largest = std::max(largest, static_cast<double>(std::fabs(coordinate)));
    }
  }
  return largest;
}

// A box that grows by points in double.
struct Extent {
  double lower[3] = {FLT_MAX, FLT_MAX, FLT_MAX};
  double upper[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};

  void add(const double point[3]) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], point[k]);
      upper[k] = std::max(upper[k], point[k]);
    }
  }

  // Within `box`, outward by `error`; inside out only without a point.
  Box within(const Box& box, double error) const {
    Box result;
    for (int k = 0; k < 3; ++k) {
      result.lower[k] = std::clamp(below_of(lower[k] - error), box.lower[k], box.upper[k]);
      result.upper[k] = std::clamp(above_of(upper[k] + error), box.lower[k], box.upper[k]);
    }
    return result;
  }
};

// The part of a polygon with sign * (x_axis - plane) >= 0 (I. Sutherland, G. Hodgman, "Reentrant
// Polygon Clipping", 1974). Returns its vertex count.
int clip_to_plane(const double (*polygon)[3], int count, int axis, double plane, double sign,
                  double (*result)[3]) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const double* a = polygon[i];
    const double* b = polygon[(i + 1) % count];
    const double side_a = sign * (a[axis] - plane);
    const double side_b = sign * (b[axis] - plane);
    if (side_a >= 0) std::copy(a, a + 3, result[kept++]);
    if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) {
      const double s = side_a / (side_a - side_b);
      // Never beyond the edge's ends, whatever is rounded: so the polygon rises and falls once
      // along each axis, and no plane adds more than one vertex.
      for (int k = 0; k < 3; ++k) {
        result[kept][k] =
            std::clamp(a[k] + s * (b[k] - a[k]), std::min(a[k], b[k]), std::max(a[k], b[k]));
      }
      result[kept++][axis] = plane;
    }
  }
  return kept;
}

}  // namespace

void split_box(const Corners& triangle, const Box& box, int axis, float position, Box& below,
               Box& above) {
  Extent low;
  Extent high;
  for (int i = 0; i < 3; ++i) {
    const float* a = triangle.at[i];
    const float* b = triangle.at[(i + 1) % 3];
    const double corner[3] = {a[0], a[1], a[2]};
    if (a[axis] <= position) low.add(corner);
    if (a[axis] >= position) high.add(corner);
    if ((a[axis] < position && b[axis] > position) || (a[axis] > position && b[axis] < position)) {
      const double s =
          (static_cast<double>(position) - a[axis]) / (static_cast<double>(b[axis]) - a[axis]);
      double cut[3];
      for (int k = 0; k < 3; ++k) cut[k] = a[k] + s * (static_cast<double>(b[k]) - a[k]);
      cut[axis] = position;
      low.add(cut);
      high.add(cut);
    }
  }
  const double error = kCutError * largest_coordinate(triangle);
  below = low.within(box, error);
  above = high.within(box, error);
  below.upper[axis] = std::min(below.upper[axis], std::max(position, below.lower[axis]));
  above.lower[axis] = std::max(above.lower[axis], std::min(position, above.upper[axis]));
}

int clip_to_box(const Corners& triangle, const Box& box, double polygon[9][3]) {
  const double error = kCutError * largest_coordinate(triangle);
  double other[9][3];
  for (int i = 0; i < 3; ++i) std::copy(triangle.at[i], triangle.at[i] + 3, polygon[i]);
  int count = 3;
  for (int k = 0; k < 3; ++k) {
    count = clip_to_plane(polygon, count, k, box.lower[k] - error, 1, other);
    count = clip_to_plane(other, count, k, box.upper[k] + error, -1, polygon);
  }
  return count;
}

}  // namespace sobb
