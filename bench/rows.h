// SPDX-License-Identifier: Apache-2.0
// Registers the rows with Google Benchmark.
#pragma once

#include <benchmark/benchmark.h>

#include <exception>
#include <string>

#include "workbench.h"

namespace sobb::bench {

void register_build_rows(Workbench& workbench);
void register_open_rows(Workbench& workbench);
void register_trace_rows(Workbench& workbench);

/// A row whose body sets the time of each iteration itself. An exception ends the row with its
/// message, not the program.
template <typename Body>
void register_row(const std::string& name, const Body& body) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [body](benchmark::State& state) {
                                 try {
                                   body(state);
                                 } catch (const std::exception& error) {
                                   state.SkipWithError(error.what());
                                 }
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace sobb::bench
