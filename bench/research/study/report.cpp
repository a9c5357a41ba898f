// SPDX-License-Identifier: Apache-2.0
#include "study/report.h"

#include <charconv>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "circumstances.h"

namespace sobb::study {

void write_report(const StudyOptions& options, const char* question, const Json& scenes) {
  const Json report = {{"question", question},
                       {"sobb", bench::library_version()},
                       {"processor", bench::processor()},
                       {"scenes", scenes}};
  const std::string text = report.dump(1) + "\n";
  if (options.out.empty()) {
    std::cout << text;
    return;
  }
  std::ofstream file(options.out);
  if (!(file << text) || !file.flush()) throw std::runtime_error(options.out + ": not written");
}

double rounded(double value) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 5);
  double result = 0;
  std::from_chars(digits, end.ptr, result);
  return result;
}

}  // namespace sobb::study
