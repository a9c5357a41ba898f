// SPDX-License-Identifier: Apache-2.0
// Reporter shows the report of sobb_bench and, on a console, a table of ratios after it.
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "median_reporter.h"
#include "row.h"

namespace sobb::bench {

/// Remembers each row's speed.
class Reporter : public MedianReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  void remember(const Run& run);
  double speed(RayKind kind, Method method, Call call) const;
  double best_peer(RayKind kind) const;
  void print_ratios(std::ostream& out) const;

  std::map<std::string, double> mrays_;  // medians by row name
  double largest_variation_ = 0;
};

}  // namespace sobb::bench
