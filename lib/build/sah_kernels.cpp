// SPDX-License-Identifier: Apache-2.0
#include "build/sah_kernels.h"

#include <algorithm>
#include <cmath>

#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/sah_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "build/sah_subtree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sobb {
namespace HWY_NAMESPACE {

const SahKernels& target_sah_kernels() {
  static constexpr SahKernels kKernels = {clear, bin, merge, find_split, partition, bound, build};
  return kKernels;
}

}  // namespace HWY_NAMESPACE
}  // namespace sobb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sobb {

Binning make_binning(const Centres& centres, uint64_t count) {
  Binning binning = {};
  binning.count = static_cast<uint32_t>(std::min<uint64_t>(kMaxBins, 4 + count / 16));
  for (int k = 0; k < 3; ++k) {
    const float extent = centres.upper[k] - centres.lower[k];
    // Just below the count, so that the last bin is never passed.
    const float scale = 0.9999F * static_cast<float>(binning.count) / extent;
    binning.base[k] = centres.lower[k];
    binning.scale[k] = extent > 0 && std::isfinite(scale) ? scale : 0;
  }
  return binning;
}

const SahKernels& sah_kernels(sobb_isa isa) {
  return isa == SOBB_ISA_AVX2 ? N_AVX2::target_sah_kernels() : N_SSE4::target_sah_kernels();
}

}  // namespace sobb
#endif
