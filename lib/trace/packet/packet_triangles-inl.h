// SPDX-License-Identifier: Apache-2.0
// The triangles of a leaf against a packet: a conservative float filter with rays in the lanes,
// then the deciding test in double, half a vector of rays at a time.
//
// Vertices are projected along the packet's central ray. For a ray whose slopes differ by (a, b)
// from the central ray's, the edge function of vertices i, j is linear in them, for the focus is
// shared:
//   x_i y_j - y_i x_j + a (y_i z_j - z_i y_j) + b (z_i x_j - x_i z_j)
// so a ray costs two multiply-adds an edge. With u = 2^-24, z the largest depth of a vertex, m its
// largest projected coordinate, c the largest central slope, a and b at most r, and g = m + r z,
// which no coordinate projected along a ray exceeds:
//   projected coordinates err by at most h = u (3 c z + 3 m + 2 r z), edge functions for it by
//   4 h g + 2 h^2; rounding the factors and the sum adds 26 u m g, the deciding test's own 4 u g^2:
// together less than u g (16 c z + 48 g) + 64 u^2 z^2. What underflows errs by less than 2^-120.
// A ray that is off the focus by (p, q), neither more than the deviation v, has all x less by p,
// all y by q, so the edge function is off by p (y_i - y_j) + q (x_j - x_i): at most 4 v g.
#if defined(SOBB_TRACE_PACKET_PACKET_TRIANGLES_INL_H) == \
    defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_PACKET_PACKET_TRIANGLES_INL_H
#undef SOBB_TRACE_PACKET_PACKET_TRIANGLES_INL_H
#else
#define SOBB_TRACE_PACKET_PACKET_TRIANGLES_INL_H
#endif

#include <hwy/highway.h>

#include "base/simd/mask_bits-inl.h"
#include "format/layout.h"
#include "trace/packet/packet_depth-inl.h"
#include "trace/packet/packet_rays-inl.h"
#include "trace/ray/query.h"
#include "trace/triangles/acceptance_lanes-inl.h"
#include "trace/triangles/watertight_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Half a vector of rays, as the deciding test takes them.
using HalfFloats = hn::Half<RayFloats>;
using HalfDoubles = hn::Rebind<double, HalfFloats>;

// The four triangles of a block before a packet.
struct PacketBlock {
  // The edge functions' constants and factors, by edge, then triangle.
  alignas(16) float constant[3][4];
  alignas(16) float along_x[3][4];
  alignas(16) float along_y[3][4];
  alignas(16) float error[4];
  alignas(16) float near[4];  // depths of the vertices, widened
  alignas(16) float far[4];

  // Projects the triangles. Returns those that a ray of the packet may hit, one bit each.
  template <class Rays>
  HWY_INLINE uint32_t make(const Rays& rays, const TriangleBlock& block) {
    const hn::CappedTag<float, 4> d;
    using V = hn::Vec<decltype(d)>;
    const int* axis = rays.projection.axis;
    const V ox = hn::Set(d, rays.permuted_focus[0]);
    const V oy = hn::Set(d, rays.permuted_focus[1]);
    const V oz = hn::Set(d, rays.permuted_focus[2]);
    const V cx = hn::Set(d, rays.centre[0]);
    const V cy = hn::Set(d, rays.centre[1]);
    const V sign = hn::Set(d, rays.sign);
    V x[3];
    V y[3];
    V z[3];
    for (int i = 0; i < 3; ++i) {
      z[i] = hn::Mul(hn::Sub(hn::Load(d, block.vertex[i][axis[2]]), oz), sign);
      x[i] = hn::NegMulAdd(cx, z[i], hn::Sub(hn::Load(d, block.vertex[i][axis[0]]), ox));
      y[i] = hn::NegMulAdd(cy, z[i], hn::Sub(hn::Load(d, block.vertex[i][axis[1]]), oy));
    }
    const V rx = hn::Set(d, rays.spread[0]);
    const V ry = hn::Set(d, rays.spread[1]);
    V least_high = hn::Set(d, INFINITY);
    V most_low = hn::Neg(least_high);
    for (int edge = 0; edge < 3; ++edge) {
      const int i = edge == 0 ? 2 : edge - 1;  // (2, 1), (0, 2), (1, 0)
      const int j = 2 - edge == 2 ? 1 : edge == 1 ? 2 : 0;
      const V c = hn::MulSub(x[i], y[j], hn::Mul(y[i], x[j]));
      const V a = hn::MulSub(y[i], z[j], hn::Mul(z[i], y[j]));
      const V b = hn::MulSub(z[i], x[j], hn::Mul(x[i], z[j]));
      hn::Store(c, d, constant[edge]);
      hn::Store(a, d, along_x[edge]);
      hn::Store(b, d, along_y[edge]);
      const V range = hn::MulAdd(hn::Abs(a), rx, hn::Mul(hn::Abs(b), ry));
      least_high = hn::Min(least_high, hn::Add(c, range));
      most_low = hn::Max(most_low, hn::Sub(c, range));
    }
    const V largest_x = hn::Max(hn::Max(hn::Abs(x[0]), hn::Abs(x[1])), hn::Abs(x[2]));
    const V largest_y = hn::Max(hn::Max(hn::Abs(y[0]), hn::Abs(y[1])), hn::Abs(y[2]));
    const V front = hn::Min(hn::Min(z[0], z[1]), z[2]);
    const V back = hn::Max(hn::Max(z[0], z[1]), z[2]);
    const V depth = hn::Max(hn::Abs(front), hn::Abs(back));
    const float r = std::max(rays.spread[0], rays.spread[1]);
    const float c = std::max(std::abs(rays.centre[0]), std::abs(rays.centre[1]));
    const V g = hn::MulAdd(depth, hn::Set(d, r), hn::Max(largest_x, largest_y));
    const V slack = hn::Mul(depth, hn::Set(d, 8 * kUnit));
    const V off = hn::MulAdd(slack, hn::Set(d, 2 * c), hn::Set(d, 4 * rays.deviation));
    const V factor = hn::MulAdd(g, hn::Set(d, 48 * kUnit), off);
    const V e = hn::MulAdd(g, factor, hn::MulAdd(slack, slack, hn::Set(d, 0x1p-120F)));
    hn::Store(e, d, error);
    const V reach = hn::Add(slack, hn::Set(d, rays.deviation));
    hn::Store(hn::Sub(front, reach), d, near);
    hn::Store(hn::Add(back, reach), d, far);
    const auto outside = hn::And(hn::Lt(least_high, hn::Neg(e)), hn::Gt(most_low, e));
    const auto beyond = hn::Gt(hn::Load(d, near), hn::Set(d, rays.beam_far[kWholePacket]));
    const auto before = hn::Lt(hn::Load(d, far), hn::Set(d, rays.beam_near[kWholePacket]));
    return ~mask_bits(d, hn::Or(outside, hn::Or(beyond, before))) & 0xF;
  }

  // Returns which of as many rays as a vector has lanes, from `first` on, may hit a triangle.
  template <class Rays>
  HWY_INLINE uint32_t filter(const Rays& rays, uint32_t triangle, size_t first) const {
    const RayFloats d;
    using V = hn::Vec<RayFloats>;
    const V a = hn::Load(d, rays.slope[0] + first);
    const V b = hn::Load(d, rays.slope[1] + first);
    V w[3];
    for (int edge = 0; edge < 3; ++edge) {
      w[edge] = hn::MulAdd(
          b, hn::Set(d, along_y[edge][triangle]),
          hn::MulAdd(a, hn::Set(d, along_x[edge][triangle]), hn::Set(d, constant[edge][triangle])));
    }
    const V e = hn::Set(d, error[triangle]);
    const auto outside = hn::And(hn::Lt(hn::Min(hn::Min(w[0], w[1]), w[2]), hn::Neg(e)),
                                 hn::Gt(hn::Max(hn::Max(w[0], w[1]), w[2]), e));
    const auto beyond = hn::Gt(hn::Set(d, near[triangle]), hn::Load(d, rays.far + first));
    const auto before = hn::Lt(hn::Set(d, far[triangle]), hn::Load(d, rays.near + first));
    return ~mask_bits(d, hn::Or(outside, hn::Or(beyond, before))) & all_lanes(d);
  }
};

// The deciding test of rays from `first` on, as many as a vector of doubles has lanes. Where it
// finds no hit t is negative; u and v are w1 / sum and w2 / sum.
struct PacketHits {
  hn::Vec<HalfFloats> t;
  hn::Vec<HalfDoubles> w1, w2, sum;
};
// `away` are the vertices, from the origin where all rays share it.
template <int kSize, bool kOwnOrigins>
HWY_INLINE PacketHits intersect(const PacketRays<kSize, kOwnOrigins>& rays,
                                const double (&away)[3][3], size_t first) {
  const HalfDoubles d;
  const HalfFloats df;
  using V = hn::Vec<HalfDoubles>;
  const V sx = hn::Load(d, rays.shear[0] + first);
  const V sy = hn::Load(d, rays.shear[1] + first);
  V px[3];
  V py[3];
  V pz[3];
  const auto relative = [&](int k, int i) HWY_ATTR {
    const V at = hn::Set(d, away[k][i]);
    if constexpr (kOwnOrigins) return hn::Sub(at, hn::Load(d, rays.origin[k] + first));
    return at;
  };
  for (int i = 0; i < 3; ++i) {
    pz[i] = relative(2, i);
    px[i] = project(d, relative(0, i), sx, pz[i]);
    py[i] = project(d, relative(1, i), sy, pz[i]);
  }
  const V w0 = vertex_weight(px[2], py[2], px[1], py[1]);
  const V w1 = vertex_weight(px[0], py[0], px[2], py[2]);
  const V w2 = vertex_weight(px[1], py[1], px[0], py[0]);
  const V sum = hn::Add(hn::Add(w0, w1), w2);
  const V t =
      hit_distance(w0, w1, w2, sum, pz[0], pz[1], pz[2], hn::Load(d, rays.direction_z + first));
  const auto hit = is_hit(d, is_inside(d, w0, w1, w2), sum, t);
  return {hn::Add(hn::DemoteTo(df, hn::IfThenElse(hit, t, hn::Set(d, -1.0))), hn::Zero(df)), w1, w2,
          sum};
}

// Offers a triangle to rays from `first` on, as ClosestHit::offer() does; `candidates` are those
// that the filter let pass. Returns whether one took it.
template <Query kQuery, int kSize, bool kOwnOrigins>
HWY_INLINE bool offer(PacketRays<kSize, kOwnOrigins>& rays, const TriangleBlock& block,
                      uint32_t triangle, size_t first, uint32_t candidates) {
  double away[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      const double from = kOwnOrigins ? 0 : rays.projection.origin[k];
      away[k][i] = block.vertex[i][rays.projection.axis[k]][triangle] - from;
    }
  }
  const HalfFloats half;
  constexpr size_t kHalf = hn::MaxLanes(HalfFloats());
  const HalfDoubles doubles;
  const auto one = hn::Set(doubles, 1.0);
  PacketHits low = {hn::Set(half, -1.0F), one, one, one};
  PacketHits high = low;
  if ((candidates & ((1U << kHalf) - 1)) != 0) low = intersect(rays, away, first);
  if (candidates >> kHalf != 0) high = intersect(rays, away, first + kHalf);

  const RayFloats d;
  const RayWords dw;
  const auto t = hn::Combine(d, high.t, low.t);
  const auto best = hn::Load(dw, rays.primitive + first);
  const auto taken =
      accepting_lanes(d, t, block.primitive[triangle], hn::Load(d, rays.tmin + first),
                      hn::Load(d, rays.limit + first), best);
  if (hn::AllFalse(d, taken)) return false;
  const auto store = [&](auto value, float* at) HWY_ATTR {
    hn::Store(hn::IfThenElse(taken, value, hn::Load(d, at)), d, at);
  };
  const auto quotient = [&](auto a, auto b) HWY_ATTR { return hn::DemoteTo(half, hn::Div(a, b)); };
  store(hn::Combine(d, quotient(high.w1, high.sum), quotient(low.w1, low.sum)), rays.u + first);
  store(hn::Combine(d, quotient(high.w2, high.sum), quotient(low.w2, low.sum)), rays.v + first);
  const auto index = hn::Set(dw, block.primitive[triangle]);
  hn::Store(hn::IfThenElse(hn::RebindMask(dw, taken), index, best), dw, rays.primitive + first);
  if (kQuery == Query::kAny) {
    const auto done = hn::Set(d, -1.0F);
    store(done, rays.limit + first);
    store(done, rays.far + first);
  } else {
    store(t, rays.limit + first);
    store(depth_beyond(d, t, hn::Load(d, rays.depth_of_one + first)), rays.far + first);
  }
  return true;
}

// Tests the triangles of a leaf against the rays of some beams, one bit each.
template <Query kQuery, int kSize, bool kOwnOrigins>
HWY_INLINE void test_leaf(PacketRays<kSize, kOwnOrigins>& rays, const TriangleBlock* block,
                          uint32_t triangles, uint32_t beams) {
  constexpr size_t kStep = kRayLanes;
  constexpr size_t kBeamRays = kSize / kBeams;
  uint32_t changed = 0;
  for (uint32_t left = 0; left < triangles; left += 4, ++block) {
    PacketBlock prepared;
    uint32_t met = prepared.make(rays, *block);
    met &= triangles - left >= 4 ? 0xF : low_bits(triangles - left);
    for (; met != 0; met &= met - 1) {
      const auto triangle = static_cast<uint32_t>(std::countr_zero(met));
      const auto test = [&](size_t first) HWY_ATTR {
        const uint32_t candidates = prepared.filter(rays, triangle, first);
        if (candidates == 0) return;
        changed |= static_cast<uint32_t>(offer<kQuery>(rays, *block, triangle, first, candidates))
                   << (first / kStep);
      };
      if constexpr (kBeamRays < kStep) {  // a vector holds rays of several beams
        for (size_t first = 0; first < kSize; first += kStep) {
          if ((beams >> (first / kBeamRays) & low_bits(kStep / kBeamRays)) != 0) test(first);
        }
      } else {
        for (uint32_t rest = beams; rest != 0; rest &= rest - 1) {
          const size_t begin = static_cast<size_t>(std::countr_zero(rest)) * kBeamRays;
          for (size_t first = begin; first < begin + kBeamRays; first += kStep) test(first);
        }
      }
    }
  }
  if (changed != 0) rays.update_beams(changed);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
