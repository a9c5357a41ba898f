// SPDX-License-Identifier: Apache-2.0
// Reporter remembers medians and prints the table of ratios.
#include "reporter.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace sobb::bench {

void Reporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) remember(run);
  MedianReporter::ReportRuns(runs);
}

void Reporter::remember(const Run& run) {
  const auto speed = run.counters.find("Mrays/s");
  if (error_of(run) != nullptr || speed == run.counters.end()) return;
  // Without repetitions there is no aggregate, and the single run is the median.
  const bool sole = run.run_type == Run::RT_Iteration && run.repetitions <= 1;
  if (sole || run.aggregate_name == "median") {
    mrays_[run.run_name.function_name] = speed->second;
  } else if (run.aggregate_name == "cv") {
    largest_variation_ = std::max<double>(largest_variation_, speed->second);
  }
}

void Reporter::Finalize() {
  MedianReporter::Finalize();
  if (on_console() && !mrays_.empty()) print_ratios(GetOutputStream());
}

double Reporter::speed(RayKind kind, Method method, Call call) const {
  const auto row = mrays_.find(row_name(kind, method, call));
  return row == mrays_.end() ? 0 : row->second;
}

double Reporter::best_peer(RayKind kind) const {
  double best = 0;
  for (const Method method : {Method::kEmbreeMedium, Method::kEmbreeHigh}) {
    for (const Call call : kCalls) best = std::max(best, speed(kind, method, call));
  }
  return best;
}

void Reporter::print_ratios(std::ostream& out) const {
  constexpr int kNameWidth = 32;
  constexpr int kCellWidth = 18;
  out << "\nMrays/s, medians (in brackets: over the fastest Embree row of the kind that is not "
         "robust)\n"
      << std::left << std::setw(kNameWidth) << "" << std::right;
  for (const Call call : kCalls) out << std::setw(kCellWidth) << name_of(call);
  out << "\n";
  for (const RayKind kind : kRayKinds) {
    const double best = best_peer(kind);
    for (const Method method : kMethods) {
      std::ostringstream line;
      line << std::fixed << std::left << std::setw(kNameWidth)
           << name_of(kind) + "/" + name_of(method) << std::right;
      bool any = false;
      for (const Call call : kCalls) {
        const double mrays = speed(kind, method, call);
        std::ostringstream cell;
        cell << std::fixed;
        if (mrays > 0) cell << std::setprecision(3) << mrays;
        if (mrays > 0 && best > 0) cell << " (" << std::setprecision(2) << mrays / best << ")";
        line << std::setw(kCellWidth) << cell.str();
        any |= mrays > 0;
      }
      if (any) out << line.str() << "\n";
    }
  }
  if (largest_variation_ == 0) return;  // one repetition
  out << "largest coefficient of variation of a row: " << std::lround(100 * largest_variation_)
      << " %\n";
}

}  // namespace sobb::bench
