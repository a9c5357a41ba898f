// SPDX-License-Identifier: Apache-2.0
// Instruction sets at the C boundary.
#include "base/isa.h"

#include "guard.h"
#include "sobb/sobb.h"

extern "C" {

using sobb::guard;
using sobb::require;

uint32_t sobb_isa_count(void) { return sobb::isa_count(); }

const char* sobb_isa_name(uint32_t isa) { return sobb::isa_name(isa); }

const char* sobb_isa_title(uint32_t isa) { return sobb::isa_title(isa); }

sobb_status sobb_isa_from_name(const char* name, sobb_isa* out) {
  return guard([&] {
    require(name, "name");
    require(out, "out");
    *out = sobb::isa_from_name(name, "isa");
  });
}

sobb_status sobb_resolve_isa(sobb_isa isa, sobb_isa* out) {
  return guard([&] {
    require(out, "out");
    *out = sobb::resolve_isa(static_cast<uint32_t>(isa));
  });
}

}  // extern "C"
