// SPDX-License-Identifier: Apache-2.0
// SobbDirect is the skewed oriented box that holds its normals, 48 bytes. They come from a table of
// up to N directions.
#if defined(SOBB_RESEARCH_VOLUMES_SOBB_DIRECT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_SOBB_DIRECT_INL_H
#undef SOBB_RESEARCH_VOLUMES_SOBB_DIRECT_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_SOBB_DIRECT_INL_H
#endif

#include <hwy/highway.h>

#include "volumes/affine_slabs-inl.h"
#include "volumes/slab_hull.h"
#include "volumes/triangles_below.h"
#include "volumes/volume.h"

HWY_BEFORE_NAMESPACE();
namespace sobb::study {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace sobb::HWY_NAMESPACE;  // the tracer's kernels for this target

template <uint32_t N>
struct SobbDirect {
  using Hull = SlabHull<N>;
  using Ray = AffineRay;

  AffineSlabs slabs;

  static SobbDirect fit(const Tables& tables, const Hull& hull, const TrianglesBelow&) {
    const TripleChoice choice = hull.choose(tables);
    SobbDirect box;
    for (int j = 0; j < 3; ++j) {
      const uint32_t k = choice.direction[j];
      box.slabs.set(j, tables.directions[k], hull.lower[k], hull.upper[k], tables.radius);
    }
    return box;
  }

  double area(const Tables&) const { return slabs.area(); }
  bool contains(const Tables&, const double p[3]) const { return slabs.contains(p); }

  template <int W>
  struct Children : AffineChildren<W> {
    void set(uint32_t i, const SobbDirect& box) { this->set_slabs(i, box.slabs); }
    SobbDirect get(uint32_t i) const { return {this->slabs(i)}; }
  };

  template <int W, class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const Ray& ray, const Children<W>& children, size_t first, V& near,
                              V& far) {
    clip_affine<W>(ray, children, first, near, far);
  }
};
static_assert(Volume<SobbDirect<32>>);

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
