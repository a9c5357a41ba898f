// SPDX-License-Identifier: Apache-2.0
// sobb_bench measures the library beside Embree. Its exit code is 0 when all rows ran and our hits
// agree, 1 when not, 2 for wrong usage.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <exception>
#include <iostream>

#include "command_line.h"
#include "context.h"
#include "flags.h"
#include "isa_flags.h"
#include "reporter.h"
#include "rows.h"
#include "verify.h"

namespace {

using namespace sobb::bench;

int run(Flags flags) {
  initialize_benchmark(flags.benchmark_arguments);

  // Calls for one ray and for a packet take their instruction set from the environment.
  if (flags.isa != "best") setenv("SOBB_ISA", flags.isa.c_str(), 1);
  if (flags.embree_isa == kSameIsa) flags.embree_isa = embree_isa_name(SOBB_ISA_BEST);
  if (peer_library() == nullptr) {
    std::cerr << "sobb_bench: Embree is not measured, since it is not there: " << why_no_peer()
              << "\n";
  }
  Workbench workbench(flags);
  add_context(workbench);
  register_build_rows(workbench);
  register_open_rows(workbench);
  register_trace_rows(workbench);

  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  std::cout << std::flush;
  if (!reporter.failure().empty()) {
    std::cerr << "sobb_bench: " << reporter.failure() << "\n";
    return 1;
  }
  return verify(workbench, std::cerr) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse_flags(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "sobb_bench: " << error.what() << "\n";
    return 1;
  }
}
