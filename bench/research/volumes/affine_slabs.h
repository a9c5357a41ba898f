// SPDX-License-Identifier: Apache-2.0
// AffineSlabs is three slabs of any normals in 48 bytes, the unit cube of an affine map
// (EG25, section 5: s = rho [n, -pmin], rho = 1 / max(pmax - pmin, epsilon)).
#pragma once

#include <algorithm>
#include <cmath>

#include "bounds/area.h"

namespace sobb::study {

struct AffineSlabs {
  float row[3][4];  // a point p, relative to the centre, is inside where 0 <= row . [p, 1] <= 1

  // Makes the slab hold every p, |p| <= radius, with lower <= n . p <= upper. With u = 2^-24 and R
  // the radius, rounding rho n moves n . p by u R at most, rounding rho pmin by u R, rounding rho
  // by u of the width: 8 u R on either side cover all of it.
  void set(int slab, const Direction& n, float lower, float upper, float radius) {
    const float margin = 8 * 0x1p-24F * radius;
    const float low = lower - margin;
    const float width = std::max(upper + margin - low, kLeastWidth);
    const float rho = 1 / width;
    row[slab][0] = rho * n.x;
    row[slab][1] = rho * n.y;
    row[slab][2] = rho * n.z;
    row[slab][3] = -rho * low;
  }

  // Slab form: with m_i = rho_i n_i and d_i = 1 / rho_i, 2 (d0 d1 + d1 d2 + d2 d0) / |det[n]| is
  // 2 (rho0 + rho1 + rho2) / |det[m]|.
  double area() const {
    double sum = 0;
    Vector m[3];
    for (int i = 0; i < 3; ++i) {
      m[i] = {row[i][0], row[i][1], row[i][2]};
      sum += length(m[i]);
    }
    return 2 * sum / std::fabs(dot(m[0], cross(m[1], m[2])));
  }

  bool contains(const double p[3]) const {
    for (const auto& s : row) {
      const double along = s[0] * p[0] + s[1] * p[1] + s[2] * p[2] + s[3];
      if (!(along >= 0 && along <= 1)) return false;
    }
    return true;
  }

 private:
  static constexpr float kLeastWidth = 0x1p-60F;  // so that products with rho do not overflow
};

}  // namespace sobb::study
