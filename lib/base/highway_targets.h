// SPDX-License-Identifier: Apache-2.0
// Include before hwy/foreach_target.h: the targets that kernels are compiled for are exactly those
// of sobb_isa.
#pragma once

#define HWY_BASELINE_TARGETS HWY_SSE4
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
