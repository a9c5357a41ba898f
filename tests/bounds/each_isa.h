// SPDX-License-Identifier: Apache-2.0
// The instruction sets of this processor.
#pragma once

#include <vector>

#include "base/error.h"
#include "base/isa.h"

namespace sobb::test {

inline std::vector<sobb_isa> each_isa() {
  std::vector<sobb_isa> isas;
  for (const sobb_isa isa : {SOBB_ISA_SSE4, SOBB_ISA_AVX2}) {
    try {
      isas.push_back(resolve_isa(isa));
    } catch (const Error&) {
      continue;  // not on this processor
    }
  }
  return isas;
}

}  // namespace sobb::test
