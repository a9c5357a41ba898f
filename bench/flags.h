// SPDX-License-Identifier: Apache-2.0
// The command line of sobb_bench: our flags, and what is left for Google Benchmark.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sobb/sobb.h"

namespace sobb::bench {

struct Flags {
  std::string scene = "builtin:hairball";
  std::string cameras;  // empty: the scene's own
  uint64_t view = 0;
  uint32_t k = 64;
  uint32_t quality = SOBB_QUALITY_MEDIUM;  // of aabb and sobb; other methods name theirs
  uint32_t strategy = SOBB_STRATEGY_K2;
  uint32_t table = SOBB_TABLE_FITTED;  // of directions for SOBBs
  uint32_t width = 8;
  uint32_t threads = 1;
  std::string isa = "best";
  uint32_t size = 1024;    // primary rays are size x size
  std::string embree_isa;  // empty: Embree's choice

  /// argv for benchmark::Initialize: the program, our defaults, the caller's --benchmark_ flags.
  std::vector<std::string> benchmark_arguments;
};

/// Reads the command line. Prints and exits with 0 for --help, with 2 for a wrong flag or value.
Flags parse_flags(int argc, char** argv);

}  // namespace sobb::bench
