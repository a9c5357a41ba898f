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

 private:
  benchmark::BenchmarkReporter& display_;
  bool on_console_;
  std::string failure_;
};

}  // namespace sobb::bench
