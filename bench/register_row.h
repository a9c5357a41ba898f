// SPDX-License-Identifier: Apache-2.0
// register_row() registers one row with Google Benchmark.
#pragma once

#include <benchmark/benchmark.h>

#include <exception>
#include <string>

namespace sobb::bench {

/// The body sets the time of each iteration itself. An exception ends the row with its message, and
/// the program goes on.
template <typename Body>
benchmark::internal::Benchmark* register_row(const std::string& name, const Body& body) {
  return benchmark::RegisterBenchmark(name.c_str(),
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
