// SPDX-License-Identifier: Apache-2.0
// The coefficients of one ray for every direction of the table: a lookup in it replaces two dot
// products per slab.
#if defined(SOBB_TRACE_NODES_RAY_TABLE_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_TRACE_NODES_RAY_TABLE_INL_H
#undef SOBB_TRACE_NODES_RAY_TABLE_INL_H
#else
#define SOBB_TRACE_NODES_RAY_TABLE_INL_H
#endif

#include <hwy/highway.h>

#include "trace/ray/slab_coefficients-inl.h"
#include "trace/trace.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

struct RayTable {
  // One vector of four per direction, so that a lookup is one load.
  struct Entry {
    float reciprocal;
    float near;
    float far;
    float unused;
  };
  alignas(64) Entry entry[kMaxDirections];

  // `ray` is a ScaledRay or a SlabRay.
  template <class Ray>
  HWY_INLINE RayTable(const TraceScene& scene, const Ray& ray) {
    const DirectionTable& directions = scene.directions;
    const hn::CappedTag<float, 8> d;  // the table of directions is padded to eight
    for (uint32_t k = 0; k < directions.count; k += static_cast<uint32_t>(hn::Lanes(d))) {
      const auto c =
          slab_coefficients(d, hn::Load(d, directions.x + k), hn::Load(d, directions.y + k),
                            hn::Load(d, directions.z + k), ray);
      hn::StoreInterleaved4(c.reciprocal, c.near, c.far, hn::Zero(d), d, &entry[k].reciprocal);
    }
  }
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
