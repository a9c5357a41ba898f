// SPDX-License-Identifier: Apache-2.0
#include "builder/boxes/frame.h"

#include <algorithm>

namespace sobb {

Frame::Frame(const DirectionSet& table, Point centre) {
  if (table.table == SOBB_TABLE_SPREAD) return;
  turned_ = true;
  std::copy_n(table.directions.begin(), 3, normal_);
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
