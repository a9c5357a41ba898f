// SPDX-License-Identifier: Apache-2.0
#include "builder/boxes/clip.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace sobb {
namespace {

// Rounding of a cut in double, relative to the largest coordinate, with room to spare.
constexpr double kCutError = 0x1p-48;

double largest_coordinate(const Corners& triangle) {
  double largest = 0;
  for (const auto& corner : triangle.at) {
    for (const double coordinate : corner) largest = std::max(largest, std::fabs(coordinate));
  }
  return largest;
}

// A box that grows by points, in double.
struct Extent {
  double lower[3] = {FLT_MAX, FLT_MAX, FLT_MAX};
  double upper[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};

  void add(const double point[3]) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], point[k]);
      upper[k] = std::max(upper[k], point[k]);
    }
  }

  // The box of the points, grown by `error` and kept within `box`; inside out only without a point.
  Box within(const Box& box, double error) const {
    Box result;
    for (int k = 0; k < 3; ++k) {
      result.lower[k] = std::clamp(float_below(lower[k] - error), box.lower[k], box.upper[k]);
      result.upper[k] = std::clamp(float_above(upper[k] + error), box.lower[k], box.upper[k]);
    }
    return result;
  }
};

// A vertex of a polygon. It is cut in the frame, and its point in the mesh follows along.
struct Vertex {
  double at[3];
  double point[3];
};

// A point of the edge from a to b, never beyond its ends, whatever is rounded: so a polygon rises
// and falls once along each axis, and no plane adds more than one vertex.
double along_edge(double a, double b, double s) {
  return std::clamp(a + s * (b - a), std::min(a, b), std::max(a, b));
}

// The part of a polygon with sign * (at_axis - plane) >= 0 (I. Sutherland, G. Hodgman, "Reentrant
// Polygon Clipping", 1974). Returns its vertex count.
int clip_to_plane(const Vertex* polygon, int count, int axis, double plane, double sign,
                  Vertex* result) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const Vertex& a = polygon[i];
    const Vertex& b = polygon[(i + 1) % count];
    const double side_a = sign * (a.at[axis] - plane);
    const double side_b = sign * (b.at[axis] - plane);
    if (side_a >= 0) result[kept++] = a;
    if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) {
      const double s = side_a / (side_a - side_b);
      Vertex& cut = result[kept++];
      for (int k = 0; k < 3; ++k) {
        cut.at[k] = along_edge(a.at[k], b.at[k], s);
        cut.point[k] = along_edge(a.point[k], b.point[k], s);
      }
      cut.at[axis] = plane;
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
    const double* a = triangle.at[i];
    const double* b = triangle.at[(i + 1) % 3];
    if (a[axis] <= position) low.add(a);
    if (a[axis] >= position) high.add(a);
    if ((a[axis] < position && b[axis] > position) || (a[axis] > position && b[axis] < position)) {
      const double s = (position - a[axis]) / (b[axis] - a[axis]);
      double cut[3];
      for (int k = 0; k < 3; ++k) cut[k] = a[k] + s * (b[k] - a[k]);
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
  Vertex vertices[9];
  Vertex other[9];
  for (int i = 0; i < 3; ++i) {
    std::copy(triangle.at[i], triangle.at[i] + 3, vertices[i].at);
    std::copy(triangle.point[i], triangle.point[i] + 3, vertices[i].point);
  }
  int count = 3;
  for (int k = 0; k < 3; ++k) {
    count = clip_to_plane(vertices, count, k, box.lower[k] - error, 1, other);
    count = clip_to_plane(other, count, k, box.upper[k] + error, -1, vertices);
  }
  for (int i = 0; i < count; ++i) {
    // Unturned, a cut lies in its plane exactly.
    const double* point = triangle.turned ? vertices[i].point : vertices[i].at;
    std::copy(point, point + 3, polygon[i]);
  }
  return count;
}

}  // namespace sobb
