// SPDX-License-Identifier: Apache-2.0
// libFuzzer's entry, compiled once per program with that program's target.
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  sobb::fuzz::SOBB_FUZZ_TARGET(std::as_bytes(std::span(data, size)));
  return 0;
}
