// SPDX-License-Identifier: Apache-2.0
// The coordinates that the topology is built in: a table fitted to a turned scene begins with the
// scene's own frame, and along that its boxes are as small as an unturned scene's along the axes.
#pragma once

#include <span>

#include "bounds/basis.h"
#include "builder/mesh.h"

namespace sobb {

class Frame {
 public:
  Frame() = default;  // the mesh's own coordinates

  // (n0 . (p - c), n1 . (p - c), n2 . (p - c)), n the first three directions of a table, which are
  // perpendicular; the mesh's own coordinates where these are the axes.
  Frame(std::span<const Direction> table, Point centre);

  bool is_turned() const { return turned_; }

  // A point of the mesh in the frame, rounded in double.
  void turn(Point p, double at[3]) const {
    if (!turned_) {
      at[0] = p.x;
      at[1] = p.y;
      at[2] = p.z;
      return;
    }
    const double x = static_cast<double>(p.x) - centre_.x;
    const double y = static_cast<double>(p.y) - centre_.y;
    const double z = static_cast<double>(p.z) - centre_.z;
    for (int k = 0; k < 3; ++k) at[k] = normal_[k].x * x + normal_[k].y * y + normal_[k].z * z;
  }

  // About the point of the mesh that turn() gives: the directions are perpendicular and of length 1
  // within rounding to float.
  void turn_back(const double at[3], double point[3]) const;

 private:
  bool turned_ = false;
  Direction normal_[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Point centre_ = {0, 0, 0};
};

}  // namespace sobb
