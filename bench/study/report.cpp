// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <charconv>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "sobb/sobb.h"

namespace sobb::study {
namespace {

std::string processor() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string library_version() {
  const uint32_t version = sobb_version();
  return std::to_string(version >> 16) + "." + std::to_string(version >> 8 & 0xFF) + "." +
         std::to_string(version & 0xFF);
}

}  // namespace

void write_report(const StudyOptions& options, const char* question, const Json& scenes) {
  const Json report = {{"question", question},
                       {"sobb", library_version()},
                       {"processor", processor()},
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
