// SPDX-License-Identifier: Apache-2.0
// Looks instruction sets up in their table, and asks the processor which of them it has.
#include "base/isa.h"

#include "base/instruction_sets.h"

#include <hwy/detect_targets.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>

#include "base/error.h"
#include "base/processor.h"

namespace sobb {
namespace {

struct InstructionSet {
  sobb_isa isa;
  int64_t target;  // Highway's bit
  const char* name;
  const char* title;
};

#define SOBB_RECORD(Type, isa, target, name, title, embree) Type{isa, HWY_##target, name, title},
constexpr InstructionSet kSets[] = {SOBB_FOR_EACH_ISA(SOBB_RECORD, InstructionSet)};
#undef SOBB_RECORD

constexpr bool sets_count_from_one() {
  for (size_t i = 0; i < std::size(kSets); ++i) {
    if (kSets[i].isa != i + 1) return false;
  }
  return true;
}
static_assert(sets_count_from_one(), "a set's place in the table is its value less 1");
static_assert(kSets[0].target == HWY_STATIC_TARGET, "the table's first set is Highway's baseline");

bool is_set(uint32_t isa) { return isa != SOBB_ISA_BEST && isa <= std::size(kSets); }

bool has(const InstructionSet& set) {
  static const int64_t supported = supported_targets();
  return (supported & set.target) != 0;
}

// The least where the processor has none: resolve_isa() then refuses it.
sobb_isa best() {
  sobb_isa found = kSets[0].isa;
  for (const InstructionSet& set : kSets) {
    if (has(set)) found = set.isa;
  }
  return found;
}

std::string all_names() {
  std::string names = isa_name(SOBB_ISA_BEST);
  for (const InstructionSet& set : kSets) names.append(", ").append(set.name);
  return names;
}

}  // namespace

uint32_t isa_count() { return std::size(kSets); }

const char* isa_name(uint32_t isa) {
  if (isa == SOBB_ISA_BEST) return "best";
  return is_set(isa) ? kSets[isa - 1].name : "unknown";
}

const char* isa_title(uint32_t isa) {
  if (isa == SOBB_ISA_BEST) return "best";
  return is_set(isa) ? kSets[isa - 1].title : "unknown";
}

sobb_isa isa_from_name(std::string_view name, const char* what) {
  for (uint32_t isa = 0; isa <= isa_count(); ++isa) {
    if (name == isa_name(isa)) return static_cast<sobb_isa>(isa);
  }
  fail(SOBB_ERROR_INVALID_ARGUMENT, "%s is %.*s, not one of %s", what,
       static_cast<int>(std::min<size_t>(name.size(), 64)), name.data(), all_names().c_str());
}

sobb_isa resolve_isa(uint32_t isa) {
  if (isa > isa_count()) fail(SOBB_ERROR_INVALID_ARGUMENT, "isa is %u, not a sobb_isa", isa);
  auto wanted = static_cast<sobb_isa>(isa);
  if (wanted == SOBB_ISA_BEST) {
    const char* name = std::getenv("SOBB_ISA");
    if (name != nullptr && *name != '\0') wanted = isa_from_name(name, "environment: SOBB_ISA");
  }
  if (wanted == SOBB_ISA_BEST) wanted = best();
  if (!has(kSets[wanted - 1])) {
    fail(SOBB_ERROR_UNSUPPORTED_CPU, "this processor has no %s", isa_title(wanted));
  }
  return wanted;
}

}  // namespace sobb
