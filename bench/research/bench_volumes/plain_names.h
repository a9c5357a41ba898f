// SPDX-License-Identifier: Apache-2.0
// PlainNames is a report whose rows have the same names in every run. Google Benchmark would add to
// each name how often the row was repeated, which depends on how long it took.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "median_reporter.h"

namespace sobb::bench::volumes {

/// A report without the repetitions in its rows' names.
template <typename Report>
class PlainNames : public Report {
 public:
  using Run = benchmark::BenchmarkReporter::Run;

  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> plain = runs;
    for (Run& run : plain) {
      run.run_name.iterations.clear();
      run.run_name.repetitions.clear();
    }
    Report::ReportRuns(plain);
  }
};

using DisplayReport = PlainNames<MedianReporter>;
using FileReport = PlainNames<benchmark::JSONReporter>;

}  // namespace sobb::bench::volumes
