// SPDX-License-Identifier: Apache-2.0
// Aabb is the axis-aligned box, 24 bytes.
#if defined(SOBB_RESEARCH_VOLUMES_AABB_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_AABB_INL_H
#undef SOBB_RESEARCH_VOLUMES_AABB_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_AABB_INL_H
#endif

#include <hwy/highway.h>

#include "trace/nodes/slab_clip-inl.h"
#include "volumes/slab_children.h"
#include "volumes/slab_hull.h"
#include "volumes/triangles_below.h"
#include "volumes/volume.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace sobb::HWY_NAMESPACE;  // the tracer's kernels for this target

struct Aabb {
  using Hull = SlabHull<8>;
  using Ray = RayTable;

  float slab[3][2];

  static Aabb fit(const Tables&, const Hull& hull, const TrianglesBelow&) {
    Aabb box;
    for (int k = 0; k < 3; ++k) {
      box.slab[k][0] = hull.lower[k];
      box.slab[k][1] = hull.upper[k];
    }
    return box;
  }

  double area(const Tables&) const {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = static_cast<double>(slab[k][1]) - slab[k][0];
    return 2 * (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]);
  }

  bool contains(const Tables&, const double p[3]) const {
    for (int k = 0; k < 3; ++k) {
      if (!(p[k] >= slab[k][0] && p[k] <= slab[k][1])) return false;
    }
    return true;
  }

  template <int W>
  struct Children : SlabChildren<3, W> {
    void set(uint32_t i, const Aabb& box) { this->set_slabs(i, box.slab); }
    Aabb get(uint32_t i) const {
      Aabb box;
      this->get_slabs(i, box.slab);
      return box;
    }
  };

  template <int W, class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const RayTable& table, const Children<W>& children, size_t first,
                              V& near, V& far) {
    for (uint32_t k = 0; k < 3; ++k) clip_shared<W>(table, children.slab[k], k, first, near, far);
  }
};
static_assert(Volume<Aabb>);

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
