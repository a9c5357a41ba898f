// SPDX-License-Identifier: Apache-2.0
// MedianReporter shows Google Benchmark's own report, on a console its medians only.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace sobb::bench {

/// Hands everything on to the display that --benchmark_format chose; a console gets medians only.
class MedianReporter : public benchmark::BenchmarkReporter {
 public:
  MedianReporter();

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  /// The first row that failed, with its message; empty if none did.
  const std::string& failure() const { return failure_; }

 protected:
  bool on_console() const { return on_console_; }

  /// The message of the error that ended @p run, or null. Google Benchmark 1.8 renamed the members.
  template <typename AnyRun>
  static const std::string* error_of(const AnyRun& run) {
    if constexpr (requires { run.error_occurred; }) {
      return run.error_occurred ? &run.error_message : nullptr;
    } else {
      return run.skipped != 0 ? &run.skip_message : nullptr;
    }
  }

 private:
  benchmark::BenchmarkReporter& display_;
  bool on_console_;
  std::string failure_;
};

}  // namespace sobb::bench
