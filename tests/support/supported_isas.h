// SPDX-License-Identifier: Apache-2.0
// The instruction sets that a test runs with: all of the library's that this processor has.
#pragma once

#include <cstdio>
#include <vector>

#include "sobb/sobb.h"

namespace sobb::test {

// From the least to the best. Prints those that the processor lacks, once per program.
inline const std::vector<sobb_isa>& supported_isas() {
  static const std::vector<sobb_isa> kSupported = [] {
    std::vector<sobb_isa> isas;
    for (uint32_t value = 1; value <= sobb_isa_count(); ++value) {
      sobb_isa isa = SOBB_ISA_BEST;
      if (sobb_resolve_isa(static_cast<sobb_isa>(value), &isa) == SOBB_OK) {
        isas.push_back(isa);
      } else {
        std::fprintf(stderr, "not tested: %s, which this processor lacks\n", sobb_isa_title(value));
      }
    }
    return isas;
  }();
  return kSupported;
}

}  // namespace sobb::test
