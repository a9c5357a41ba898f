// SPDX-License-Identifier: Apache-2.0
// A conservative float filter in front of the triangle test, four triangles at a time: it never
// drops a triangle that the test in double accepts. Included once for each Highway target.
//
// The projection is that of triangle_test.h in float. With M at least the distance from the origin
// to any vertex, u = 2^-24, and m the largest projected coordinate of a triangle:
//   a projected coordinate errs by at most h = 8 u M,
//   an edge function x1 y2 - y1 x2 by at most 4 h m + 2 h^2 + 6 u m^2 <= 64 u M (m + 8 u M),
// and t lies in the hull of the vertices' depths, which err by at most 8 u M.
#if defined(SOBB_TRACE_TRIANGLE_FILTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_TRACE_TRIANGLE_FILTER_INL_H
#undef SOBB_TRACE_TRIANGLE_FILTER_INL_H
#else
#define SOBB_TRACE_TRIANGLE_FILTER_INL_H
#endif

#include <hwy/highway.h>

#include "trace/scaled_ray.h"
#include "trace/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE uint32_t mask_bits(hn::CappedTag<float, 4> d, hn::Mask<hn::CappedTag<float, 4>> mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

// A ray before the triangles of a block.
class BlockRay {
 public:
  BlockRay(const sobb_ray& ray, const ScaledRay& scaled)
      : exact_(ray),
        shear_x_(static_cast<float>(exact_.shear_x)),
        shear_y_(static_cast<float>(exact_.shear_y)),
        reciprocal_z_(1 / scaled.direction[exact_.axis[2]]),
        edge_error_(64 * 0x1p-24F * scaled.reach),
        slack_(8 * 0x1p-24F * scaled.reach),
        tmin_(scaled.tmin) {
    for (int k = 0; k < 3; ++k) origin_[k] = ray.origin[exact_.axis[k]];
  }

  // The lanes of a block that the ray may hit at a scaled t up to `limit`.
  HWY_INLINE uint32_t filter(const TriangleBlock& block, float limit) const {
    const hn::CappedTag<float, 4> d;
    using V = hn::Vec<decltype(d)>;
    const V ox = hn::Set(d, origin_[0]);
    const V oy = hn::Set(d, origin_[1]);
    const V oz = hn::Set(d, origin_[2]);
    const V sx = hn::Set(d, shear_x_);
    const V sy = hn::Set(d, shear_y_);
    const auto z = [&](int i) HWY_ATTR {
      return hn::Sub(hn::Load(d, block.vertex[i][exact_.axis[2]]), oz);
    };
    const auto x = [&](int i, V depth) HWY_ATTR {
      return hn::NegMulAdd(sx, depth, hn::Sub(hn::Load(d, block.vertex[i][exact_.axis[0]]), ox));
    };
    const auto y = [&](int i, V depth) HWY_ATTR {
      return hn::NegMulAdd(sy, depth, hn::Sub(hn::Load(d, block.vertex[i][exact_.axis[1]]), oy));
    };
    const V z0 = z(0);
    const V z1 = z(1);
    const V z2 = z(2);
    const V x0 = x(0, z0);
    const V x1 = x(1, z1);
    const V x2 = x(2, z2);
    const V y0 = y(0, z0);
    const V y1 = y(1, z1);
    const V y2 = y(2, z2);

    const V w0 = hn::MulSub(x2, y1, hn::Mul(y2, x1));
    const V w1 = hn::MulSub(x0, y2, hn::Mul(y0, x2));
    const V w2 = hn::MulSub(x1, y0, hn::Mul(y1, x0));
    const V largest_x = hn::Max(hn::Max(hn::Abs(x0), hn::Abs(x1)), hn::Abs(x2));
    const V largest_y = hn::Max(hn::Max(hn::Abs(y0), hn::Abs(y1)), hn::Abs(y2));
    const V error = hn::Mul(hn::Set(d, edge_error_),
                            hn::Add(hn::Max(largest_x, largest_y), hn::Set(d, slack_)));
    // Weights certainly of both signs: outside. (Not-a-number, from overflow, is never certain.)
    const auto outside = hn::And(hn::Lt(hn::Min(hn::Min(w0, w1), w2), hn::Neg(error)),
                                 hn::Gt(hn::Max(hn::Max(w0, w1), w2), error));

    const V rz = hn::Set(d, reciprocal_z_);
    const V t0 = hn::Mul(z0, rz);
    const V t1 = hn::Mul(z1, rz);
    const V t2 = hn::Mul(z2, rz);
    const V slack = hn::Set(d, slack_);
    const auto beyond = hn::Gt(hn::Sub(hn::Min(hn::Min(t0, t1), t2), slack), hn::Set(d, limit));
    const auto before = hn::Lt(hn::Add(hn::Max(hn::Max(t0, t1), t2), slack), hn::Set(d, tmin_));
    return ~mask_bits(d, hn::Or(outside, hn::Or(beyond, before))) & 0xF;
  }

  // The deciding test of one lane.
  HWY_INLINE bool test(const TriangleBlock& block, uint32_t lane, TriangleHit& hit) const {
    float vertex[3][3];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) vertex[k][i] = block.vertex[i][exact_.axis[k]][lane];
    }
    return intersect_triangle(exact_, vertex[0], vertex[1], vertex[2], hit);
  }

 private:
  TriangleRay exact_;
  float origin_[3];
  float shear_x_;
  float shear_y_;
  float reciprocal_z_;
  float edge_error_;
  float slack_;
  float tmin_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
