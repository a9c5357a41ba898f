// SPDX-License-Identifier: Apache-2.0
// Dop14 is the 14-DOP: seven slabs, along the axes and the diagonals of a cube.
#if defined(SOBB_RESEARCH_VOLUMES_DOP14_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_DOP14_INL_H
#undef SOBB_RESEARCH_VOLUMES_DOP14_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_DOP14_INL_H
#endif

#include <hwy/highway.h>

#include "trace/nodes/slab_clip-inl.h"
#include "volumes/dop_area.h"
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

struct Dop14 {
  static constexpr int kSlabs = 7;
  using Hull = SlabHull<8>;
  using Ray = RayTable;

  float slab[kSlabs][2];

  static Dop14 fit(const Tables&, const Hull& hull, const TrianglesBelow&) {
    Dop14 dop;
    for (int k = 0; k < kSlabs; ++k) {
      dop.slab[k][0] = hull.lower[k];
      dop.slab[k][1] = hull.upper[k];
    }
    return dop;
  }

  double area(const Tables& tables) const { return dop_area(tables.directions, slab); }

  bool contains(const Tables& tables, const double p[3]) const {
    for (int k = 0; k < kSlabs; ++k) {
      const Direction& n = tables.directions[k];
      const double along = n.x * p[0] + n.y * p[1] + n.z * p[2];
      if (!(along >= slab[k][0] && along <= slab[k][1])) return false;
    }
    return true;
  }

  template <int W>
  struct Children : SlabChildren<kSlabs, W> {
    void set(uint32_t i, const Dop14& dop) { this->set_slabs(i, dop.slab); }
    Dop14 get(uint32_t i) const {
      Dop14 dop;
      this->get_slabs(i, dop.slab);
      return dop;
    }
  };

  template <int W, class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const RayTable& table, const Children<W>& children, size_t first,
                              V& near, V& far) {
    for (int k = 0; k < kSlabs; ++k) {
      clip_shared<W>(table, children.slab[k], static_cast<uint32_t>(k), first, near, far);
    }
  }
};
static_assert(Volume<Dop14>);

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
