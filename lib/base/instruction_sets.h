// SPDX-License-Identifier: Apache-2.0
// The table of instruction sets. Kernels, names and tests all read it; a new set is a row here and
// an enumerator of sobb_isa. Kernels include this header before any header of Highway.
#pragma once

#include <cstddef>

#include "base/error.h"
#include "sobb/sobb.h"

// Calls X(argument, sobb_isa, Highway's target, our name, title, Embree's name) for every set, from
// the least to the best. The name is that of command lines and of the environment's SOBB_ISA, the
// title is for people, and Embree's name is what its device option `isa` calls the same set.
#define SOBB_FOR_EACH_ISA(X, argument)                         \
  X(argument, SOBB_ISA_SSE4, SSE4, "sse4", "SSE4.2", "sse4.2") \
  X(argument, SOBB_ISA_AVX2, AVX2, "avx2", "AVX2", "avx2")

// Highway compiles kernels for the table's targets and no others. The least is the baseline: code
// outside of kernels, and every processor that the library runs on, has it.
#define SOBB_OR_TARGET(prefix, isa, target, name, title, embree) | prefix##target
#define HWY_BASELINE_TARGETS HWY_SSE4
#define HWY_DISABLED_TARGETS (~(0 SOBB_FOR_EACH_ISA(SOBB_OR_TARGET, HWY_)))

// SOBB_DISPATCH(isa, function) is the `function` that was compiled for a set. Highway puts what it
// compiles for the target T into a namespace N_T.
#define SOBB_TARGET_FUNCTION(function, isa, target, name, title, embree) N_##target::function,
#define SOBB_DISPATCH(isa, function) \
  ::sobb::function_of(isa, {SOBB_FOR_EACH_ISA(SOBB_TARGET_FUNCTION, function)})

namespace sobb {

// The one of `functions`, in the table's order, for a set that resolve_isa() returned.
template <class Function, size_t kCount>
Function* function_of(sobb_isa isa, Function* const (&functions)[kCount]) {
  const size_t index = static_cast<size_t>(isa) - 1;  // isa.cpp asserts that sets count from 1
  if (index >= kCount) fail(SOBB_ERROR_INTERNAL, "no kernels for isa %d", static_cast<int>(isa));
  return functions[index];
}

}  // namespace sobb
