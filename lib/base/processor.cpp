// SPDX-License-Identifier: Apache-2.0
// Asks cpuid for what Highway's targets compile to. A set of vector registers that the system does
// not save when it switches threads is as good as none, which xgetbv tells.
#include "base/processor.h"

#include "base/instruction_sets.h"

#include <cpuid.h>
#include <hwy/detect_targets.h>

#include <algorithm>
#include <initializer_list>

namespace sobb {
namespace {

struct CpuidWords {
  unsigned eax = 0;
  unsigned ebx = 0;
  unsigned ecx = 0;
  unsigned edx = 0;

  // All zero where the processor does not know the leaf.
  explicit CpuidWords(unsigned leaf) { __get_cpuid_count(leaf, 0, &eax, &ebx, &ecx, &edx); }
};

bool has(unsigned word, std::initializer_list<int> bits) {
  return std::all_of(bits.begin(), bits.end(), [&](int bit) { return (word >> bit & 1) != 0; });
}

// Tells whether the system saves the registers of SSE and AVX, bits 1 and 2 of XCR0.
bool saves_avx(const CpuidWords& basic) {
  if (!has(basic.ecx, {27})) return false;  // OSXSAVE: xgetbv may be used
  unsigned low = 0;
  unsigned high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return has(low, {1, 2});
}

}  // namespace

int64_t supported_targets() {
  const CpuidWords basic(1);
  const CpuidWords structured(7);
  const CpuidWords extended(0x80000001);
  int64_t targets = 0;
  // PCLMULQDQ, SSSE3, SSE4.1, SSE4.2, POPCNT, AES.
  if (!has(basic.ecx, {1, 9, 19, 20, 23, 25})) return targets;
  targets |= HWY_SSE4;
  // FMA, AVX, F16C; BMI, AVX2, BMI2; LZCNT.
  if (has(basic.ecx, {12, 28, 29}) && has(structured.ebx, {3, 5, 8}) && has(extended.ecx, {5}) &&
      saves_avx(basic)) {
    targets |= HWY_AVX2;
  }
  return targets;
}

}  // namespace sobb
