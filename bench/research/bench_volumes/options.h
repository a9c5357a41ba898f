// SPDX-License-Identifier: Apache-2.0
// The command line of sobb_bench_volumes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sobb/sobb.h"

namespace sobb::bench::volumes {

struct Options {
  std::string scene = "builtin:hairball";
  std::string cameras;  // empty: the scene's own
  uint64_t view = 0;
  uint32_t size = 512;  // primary rays are size x size
  uint32_t threads = 2;
  sobb_isa isa = SOBB_ISA_BEST;
  std::vector<sobb_strategy> strategies{SOBB_STRATEGY_K2};
  std::vector<uint32_t> widths{2, 8};
  double cell_seconds = 2;  // of all repetitions of a row together

  /// argv for benchmark::Initialize.
  std::vector<std::string> benchmark_arguments;
};

/// Prints and exits with 0 for --help, with 2 for a wrong flag or value.
Options parse_options(int argc, char** argv);

}  // namespace sobb::bench::volumes
