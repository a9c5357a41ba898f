// SPDX-License-Identifier: Apache-2.0
// SobbIndexed is the skewed oriented box with indices into the direction table, 26 bytes.
#if defined(SOBB_RESEARCH_VOLUMES_SOBB_INDEXED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_RESEARCH_VOLUMES_SOBB_INDEXED_INL_H
#undef SOBB_RESEARCH_VOLUMES_SOBB_INDEXED_INL_H
#else
#define SOBB_RESEARCH_VOLUMES_SOBB_INDEXED_INL_H
#endif

#include <hwy/highway.h>

#include "bounds/area.h"
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

struct SobbIndexed {
  using Hull = SlabHull<kMaxDirections>;
  using Ray = RayTable;

  float slab[3][2];
  uint16_t basis;

  static SobbIndexed fit(const Tables& tables, const Hull& hull, const TrianglesBelow&) {
    const TripleChoice choice = hull.choose(tables);
    SobbIndexed box;
    for (int j = 0; j < 3; ++j) {
      box.slab[j][0] = hull.lower[choice.direction[j]];
      box.slab[j][1] = hull.upper[choice.direction[j]];
    }
    box.basis = make_basis(choice.direction[0], choice.direction[1], choice.direction[2]);
    return box;
  }

  double area(const Tables& tables) const {
    Direction normal[3];
    double width[3];
    for (int j = 0; j < 3; ++j) {
      normal[j] = tables.directions[basis_direction(basis, j)];
      width[j] = static_cast<double>(slab[j][1]) - slab[j][0];
    }
    return slab_area(normal, width);
  }

  bool contains(const Tables& tables, const double p[3]) const {
    for (int j = 0; j < 3; ++j) {
      const Direction& n = tables.directions[basis_direction(basis, j)];
      const double along = n.x * p[0] + n.y * p[1] + n.z * p[2];
      if (!(along >= slab[j][0] && along <= slab[j][1])) return false;
    }
    return true;
  }

  template <int W>
  struct Children : SlabChildren<3, W> {
    uint16_t basis[W];

    void set(uint32_t i, const SobbIndexed& box) {
      this->set_slabs(i, box.slab);
      basis[i] = box.basis;
    }
    SobbIndexed get(uint32_t i) const {
      SobbIndexed box;
      this->get_slabs(i, box.slab);
      box.basis = basis[i];
      return box;
    }
  };

  template <int W, class V = hn::Vec<ChildFloats<W>>>
  static HWY_INLINE void clip(const RayTable& table, const Children<W>& children, size_t first,
                              V& near, V& far) {
    for (int j = 0; j < 3; ++j) {
      clip_own<W>(table, children.slab[j], children.basis + first, j, first, near, far);
    }
  }
};
static_assert(Volume<SobbIndexed>);

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb::study
HWY_AFTER_NAMESPACE();

#endif
