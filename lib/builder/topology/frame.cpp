// SPDX-License-Identifier: Apache-2.0
#include "builder/topology/frame.h"

#include <algorithm>

namespace sobb {

Frame::Frame(std::span<const Direction> table, Point centre) {
  for (int k = 0; k < 3; ++k) {
    const Direction& n = table[k];
    if (n.x != normal_[k].x || n.y != normal_[k].y || n.z != normal_[k].z) turned_ = true;
  }
  if (!turned_) return;
  std::copy_n(table.begin(), 3, normal_);
  centre_ = centre;
}

void Frame::turn_back(const double at[3], double point[3]) const {
  point[0] = centre_.x;
  point[1] = centre_.y;
  point[2] = centre_.z;
  for (int k = 0; k < 3; ++k) {
    point[0] += at[k] * normal_[k].x;
    point[1] += at[k] * normal_[k].y;
    point[2] += at[k] * normal_[k].z;
  }
}

}  // namespace sobb
