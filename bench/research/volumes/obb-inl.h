// SPDX-License-Identifier: Apache-2.0
// Obb is the oriented box, whose orientation the ditetrahedron chooses, 48 bytes.
#if defined(SOBB_RESEARCH_VOLUMES_OBB_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_OBB_INL_H
#undef SOBB_RESEARCH_VOLUMES_OBB_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_OBB_INL_H
#endif

#include <hwy/highway.h>

#include "volumes/affine_slabs-inl.h"
#include "volumes/ditetrahedron.h"
#include "volumes/triangles_below.h"
#include "volumes/volume.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace sobb::HWY_NAMESPACE;  // the tracer's kernels for this target

// Finds the extents lower[j] <= n_j . (p - c) <= upper[j] of triangles, rounding included:
// difference and product err by at most u |p| and 3 u |p|, and |p| is at most the radius.
inline void extents_along(const Tables& tables, const TrianglesBelow& below,
                          const Direction normal[3], float lower[3], float upper[3]) {
  const hn::CappedTag<float, 4> d;  // a block's triangles
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
  V low[3];
  V high[3];
  for (int j = 0; j < 3; ++j) {
    low[j] = hn::Set(d, INFINITY);
    high[j] = hn::Set(d, -INFINITY);
  }
  for (const BlockRange& range : below.ranges) {
    for (uint64_t at = range.first; at < range.end; ++at) {
      const TriangleBlock& block = below.blocks[at];
      const auto primitives = hn::LoadU(du, block.primitive);
      const auto used = hn::RebindMask(d, hn::Ne(primitives, hn::Set(du, kNoPrimitive)));
      for (const auto& vertex : block.vertex) {
        const V x = hn::Sub(hn::LoadU(d, vertex[0]), hn::Set(d, tables.centre[0]));
        const V y = hn::Sub(hn::LoadU(d, vertex[1]), hn::Set(d, tables.centre[1]));
        const V z = hn::Sub(hn::LoadU(d, vertex[2]), hn::Set(d, tables.centre[2]));
        for (int j = 0; j < 3; ++j) {
          const V along = hn::Add(
              hn::Add(hn::Mul(hn::Set(d, normal[j].x), x), hn::Mul(hn::Set(d, normal[j].y), y)),
              hn::Mul(hn::Set(d, normal[j].z), z));
          low[j] = hn::IfThenElse(used, hn::Min(low[j], along), low[j]);
          high[j] = hn::IfThenElse(used, hn::Max(high[j], along), high[j]);
        }
      }
    }
  }
  const float error = 6 * 0x1p-24F * tables.radius;
  for (int j = 0; j < 3; ++j) {
    lower[j] = hn::GetLane(hn::MinOfLanes(d, low[j])) - error;
    upper[j] = hn::GetLane(hn::MaxOfLanes(d, high[j])) + error;
  }
}

struct Obb {
  using Hull = ExtremalPoints;
  using Ray = AffineRay;

  AffineSlabs slabs;

  // The ditetrahedron judges by 14 points. For all triangles the axes of space may be better.
  static Obb fit(const Tables& tables, const Hull& hull, const TrianglesBelow& below) {
    Direction basis[3];
    ditetrahedron_basis(hull, basis);
    const Obb oriented = along(tables, below, basis);
    const Direction axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    float lower[3];
    float upper[3];
    const float error = 6 * 0x1p-24F * tables.radius;
    for (int k = 0; k < 3; ++k) {
      lower[k] = hull.along[k][0] - error;
      upper[k] = hull.along[k][1] + error;
    }
    const Obb straight = of_slabs(tables, axes, lower, upper);
    return oriented.slabs.area() < straight.slabs.area() ? oriented : straight;
  }

  double area(const Tables&) const { return slabs.area(); }
  bool contains(const Tables&, const double p[3]) const { return slabs.contains(p); }

  template <int W>
  struct Children : AffineChildren<W> {
    void set(uint32_t i, const Obb& box) { this->set_slabs(i, box.slabs); }
    Obb get(uint32_t i) const { return {this->slabs(i)}; }
  };

  template <int W, class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const Ray& ray, const Children<W>& children, size_t first, V& near,
                              V& far) {
    clip_affine<W>(ray, children, first, near, far);
  }

 private:
  static Obb along(const Tables& tables, const TrianglesBelow& below, const Direction basis[3]) {
    float lower[3];
    float upper[3];
    extents_along(tables, below, basis, lower, upper);
    return of_slabs(tables, basis, lower, upper);
  }

  static Obb of_slabs(const Tables& tables, const Direction basis[3], const float lower[3],
                      const float upper[3]) {
    Obb box;
    for (int j = 0; j < 3; ++j) box.slabs.set(j, basis[j], lower[j], upper[j], tables.radius);
    return box;
  }
};
static_assert(Volume<Obb>);

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
