// SPDX-License-Identifier: Apache-2.0
// The coordinates that the topology is built in. A table fitted to a turned scene begins with the
// scene's own frame; boxes along that frame are as small as an unturned scene's along the axes.
#pragma once

#include "bounds/directions/direction_table.h"
#include "builder/mesh.h"

namespace sobb {

class Frame {
 public:
  Frame() = default;  // the mesh's own coordinates

  // The coordinates (n0 . (p - c), n1 . (p - c), n2 . (p - c)), where n0, n1, n2 are the table's
  // first three directions, which are perpendicular. A spread table begins with the axes: its frame
  // is the mesh's own coordinates.
  Frame(const DirectionSet& table, Point centre);

  bool is_turned() const { return turned_; }

  // Takes a point of the mesh into the frame; rounds in double.
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

  // Takes a point of the frame to about the point of the mesh that turn() came from: the directions
  // are perpendicular and of length 1 only within rounding to float.
  void turn_back(const double at[3], double point[3]) const;

 private:
  bool turned_ = false;
  Direction normal_[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Point centre_ = {0, 0, 0};
};

}  // namespace sobb
