// SPDX-License-Identifier: Apache-2.0
// sobb_bench_volumes compares all bounding volumes of the paper. Its exit code is 0 when all rows
// ran and all hits agree, 1 when not, 2 for wrong usage.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <iostream>

#include "bench_volumes/context.h"
#include "bench_volumes/options.h"
#include "bench_volumes/plain_names.h"
#include "bench_volumes/rows.h"
#include "command_line.h"

namespace {

using namespace sobb::bench::volumes;

// Google Benchmark refuses a report for a file where no file was asked for.
bool writes_file(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
    return argument.starts_with("--benchmark_out=");
  });
}

int run(Options options) {
  sobb::bench::initialize_benchmark(options.benchmark_arguments);
  Workbench workbench(options);
  add_context(workbench);
  register_build_rows(workbench);
  register_overhead_rows(workbench);
  register_trace_rows(workbench);

  DisplayReport display;
  FileReport file;
  benchmark::RunSpecifiedBenchmarks(&display,
                                    writes_file(options.benchmark_arguments) ? &file : nullptr);
  std::cout << std::flush;
  if (display.failure().empty()) return 0;
  std::cerr << "sobb_bench_volumes: " << display.failure() << "\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse_options(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "sobb_bench_volumes: " << error.what() << "\n";
    return 1;
  }
}
