// SPDX-License-Identifier: Apache-2.0
// The lanes of a mask as the bits of a word, lane 0 lowest.
#if defined(SOBB_BASE_SIMD_MASK_BITS_INL_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef SOBB_BASE_SIMD_MASK_BITS_INL_H
#undef SOBB_BASE_SIMD_MASK_BITS_INL_H
#else
#define SOBB_BASE_SIMD_MASK_BITS_INL_H
#endif

#include <hwy/highway.h>

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A word whose `count` lowest bits are set; `count` is less than 32.
constexpr uint32_t low_bits(uint32_t count) { return (1U << count) - 1; }

// The bits of all lanes of a vector.
template <class D>
constexpr uint32_t all_lanes(D) {
  static_assert(hn::MaxLanes(D()) < 32);
  return low_bits(hn::MaxLanes(D()));
}

template <class D>
HWY_INLINE uint32_t mask_bits(D d, hn::Mask<D> mask) {
  static_assert(hn::MaxLanes(D()) < 32);
  uint8_t bytes[8] = {};  // as many as StoreMaskBits may write
  hn::StoreMaskBits(d, mask, bytes);
  if constexpr (hn::MaxLanes(D()) <= 8) return bytes[0];
  uint32_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#endif
