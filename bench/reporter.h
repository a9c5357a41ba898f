// SPDX-License-Identifier: Apache-2.0
// What the run shows: Google Benchmark's own report, and on a console a table of ratios after it.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "row.h"

namespace sobb::bench {

/// Hands everything on to the display that --benchmark_format chose (a console gets medians only)
/// and remembers each row's speed.
class Reporter : public benchmark::BenchmarkReporter {
 public:
  Reporter();

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  /// The first row that failed, with its message; empty if none did.
  const std::string& failure() const { return failure_; }

 private:
  void remember(const Run& run);
  double speed(RayKind kind, Method method, Call call) const;
  double best_peer(RayKind kind) const;
  void print_ratios(std::ostream& out) const;

  benchmark::BenchmarkReporter& display_;
  bool on_console_;
  std::string failure_;
  std::map<std::string, double> mrays_;  // medians by row name
  double largest_variation_ = 0;
};

}  // namespace sobb::bench
