// SPDX-License-Identifier: Apache-2.0
// Reads the library's table of instruction sets, which alone has Embree's names.
#include "isa_flags.h"

#include "base/instruction_sets.h"
#include "check.h"

namespace sobb::bench {

std::vector<std::string> isa_choices() {
  std::vector<std::string> choices;
  for (uint32_t isa = SOBB_ISA_BEST; isa <= sobb_isa_count(); ++isa) {
    choices.emplace_back(sobb_isa_name(isa));
  }
  return choices;
}

std::string embree_isa_name(sobb_isa isa) {
  struct Named {
    sobb_isa isa;
    const char* embree;
  };
#define SOBB_NAMED(Type, isa, target, name, title, embree) Type{isa, embree},
  static constexpr Named kNames[] = {SOBB_FOR_EACH_ISA(SOBB_NAMED, Named)};
#undef SOBB_NAMED
  sobb_isa resolved = SOBB_ISA_BEST;
  check(sobb_resolve_isa(isa, &resolved));
  return kNames[resolved - 1].embree;
}

}  // namespace sobb::bench
