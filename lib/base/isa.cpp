// SPDX-License-Identifier: Apache-2.0
#include "base/isa.h"

#include <hwy/targets.h>

#include <cstdlib>

#include "base/error.h"

namespace sobb {
namespace {

bool supports(sobb_isa isa) {
  const auto target = isa == SOBB_ISA_AVX2 ? HWY_AVX2 : HWY_SSE4;
  return (hwy::SupportedTargets() & target) != 0;
}

sobb_isa parse(std::string_view name) {
  if (name == "sse4") return SOBB_ISA_SSE4;
  if (name == "avx2") return SOBB_ISA_AVX2;
  fail(SOBB_ERROR_INVALID_ARGUMENT, "environment: SOBB_ISA is %.*s, neither sse4 nor avx2",
       static_cast<int>(name.size()), name.data());
}

}  // namespace

sobb_isa resolve_isa(uint32_t isa) {
  if (isa > SOBB_ISA_AVX2) fail(SOBB_ERROR_INVALID_ARGUMENT, "isa is %u, not a sobb_isa", isa);
  auto wanted = static_cast<sobb_isa>(isa);
  if (wanted == SOBB_ISA_BEST) {
    const char* name = std::getenv("SOBB_ISA");
    if (name != nullptr && *name != '\0') {
      wanted = parse(name);
    } else {
      wanted = supports(SOBB_ISA_AVX2) ? SOBB_ISA_AVX2 : SOBB_ISA_SSE4;
    }
  }
  if (!supports(wanted)) {
    fail(SOBB_ERROR_UNSUPPORTED_CPU, "this processor has no %s",
         wanted == SOBB_ISA_AVX2 ? "AVX2" : "SSE4.2");
  }
  return wanted;
}

}  // namespace sobb
