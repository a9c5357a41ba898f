// SPDX-License-Identifier: Apache-2.0
// The lanes of a mask as bits. Included once for each Highway target.
#if defined(SOBB_BASE_SIMD_MASK_BITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SOBB_BASE_SIMD_MASK_BITS_INL_H
#undef SOBB_BASE_SIMD_MASK_BITS_INL_H
#else
#define SOBB_BASE_SIMD_MASK_BITS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Of up to 8 lanes.
template <class D>
HWY_INLINE uint32_t mask_bits(D d, hn::Mask<D> mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
