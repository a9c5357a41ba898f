// SPDX-License-Identifier: Apache-2.0
// The ray test of three slabs of any normals takes 48 bytes per child.
//
// For a row s = [m, w], m = rho n: so = m . o + w, sd = m . d, and the ray is within the slab for t
// from the lesser to the greater of (0 - so) / sd and (1 - so) / sd. The error of
// trace/ray/slab_coefficients-inl.h, e along a unit normal, is rho e here; |m_x| + |m_y| + |m_z| is
// no less than rho.
#if defined(SOBB_RESEARCH_VOLUMES_AFFINE_SLABS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_AFFINE_SLABS_INL_H
#undef SOBB_RESEARCH_VOLUMES_AFFINE_SLABS_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_AFFINE_SLABS_INL_H
#endif

#include <hwy/highway.h>

#include "trace/nodes/slab_clip-inl.h"
#include "volumes/affine_slabs.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace sobb::HWY_NAMESPACE;  // the tracer's kernels for this target

// The ray's side of the test. Nothing is precomputed.
struct AffineRay {
  float origin[3];
  float direction[3];
  float error;

  HWY_INLINE AffineRay(const TraceScene&, const ScaledRay& ray)
      : origin{ray.origin[0], ray.origin[1], ray.origin[2]},
        direction{ray.direction[0], ray.direction[1], ray.direction[2]},
        error(ray.error) {}
};

template <int W>
struct AffineChildren {
  float row[3][4][W];

  void set_slabs(uint32_t i, const AffineSlabs& slabs) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 4; ++k) row[j][k][i] = slabs.row[j][k];
    }
  }
  AffineSlabs slabs(uint32_t i) const {
    AffineSlabs result;
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 4; ++k) result.row[j][k] = row[j][k][i];
    }
    return result;
  }
};

template <int W, class V = hn::Vec<ChildFloats<W>>>
HWY_INLINE void clip_affine(const AffineRay& ray, const AffineChildren<W>& children, size_t first,
                            V& near, V& far) {
  const ChildFloats<W> d;
  const V one = hn::Set(d, 1.0F);
  for (int j = 0; j < 3; ++j) {
    const V mx = hn::Load(d, children.row[j][0] + first);
    const V my = hn::Load(d, children.row[j][1] + first);
    const V mz = hn::Load(d, children.row[j][2] + first);
    const V w = hn::Load(d, children.row[j][3] + first);
    const V so = hn::MulAdd(
        mz, hn::Set(d, ray.origin[2]),
        hn::MulAdd(my, hn::Set(d, ray.origin[1]), hn::MulAdd(mx, hn::Set(d, ray.origin[0]), w)));
    const V sd = hn::MulAdd(
        mz, hn::Set(d, ray.direction[2]),
        hn::MulAdd(my, hn::Set(d, ray.direction[1]), hn::Mul(mx, hn::Set(d, ray.direction[0]))));
    const V rho = hn::Add(hn::Abs(mx), hn::Add(hn::Abs(my), hn::Abs(mz)));
    const V slack = hn::Mul(rho, hn::Set(d, ray.error));
    const V least = hn::Max(hn::Mul(rho, hn::Set(d, kSmallestCosine)), hn::Set(d, 0x1p-120F));
    const V r = hn::Div(one, hn::CopySign(hn::Max(hn::Abs(sd), least), sd));
    const V lower = hn::Mul(hn::Neg(hn::Add(so, slack)), r);
    const V upper = hn::Mul(hn::Add(hn::Sub(one, so), slack), r);
    near = hn::Max(near, hn::Min(lower, upper));
    far = hn::Min(far, hn::Max(lower, upper));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
