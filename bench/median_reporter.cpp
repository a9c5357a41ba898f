// SPDX-License-Identifier: Apache-2.0
// MedianReporter passes rows on and remembers the first that failed.
#include "median_reporter.h"

namespace sobb::bench {

// The default display lives as long as the program.
MedianReporter::MedianReporter()
    : display_(*benchmark::CreateDefaultDisplayReporter()),
      on_console_(dynamic_cast<benchmark::ConsoleReporter*>(&display_) != nullptr) {}

bool MedianReporter::ReportContext(const Context& context) {
  return display_.ReportContext(context);
}

void MedianReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> shown;
  for (const Run& run : runs) {
    if (const std::string* error = error_of(run); error != nullptr && failure_.empty()) {
      failure_ = run.run_name.function_name + ": " + *error;
    }
    const bool other_statistic =
        run.run_type == Run::RT_Aggregate && run.aggregate_name != "median";
    if (!on_console_ || !other_statistic) shown.push_back(run);
  }
  if (!shown.empty()) display_.ReportRuns(shown);
}

void MedianReporter::Finalize() { display_.Finalize(); }

}  // namespace sobb::bench
