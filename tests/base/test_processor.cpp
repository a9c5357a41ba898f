// SPDX-License-Identifier: Apache-2.0
// What the library finds of the processor is what Linux finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include "support/supported_isas.h"

namespace sobb::test {
namespace {

std::set<std::string> linux_flags() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (!line.starts_with("flags")) continue;
    std::istringstream words(line.substr(line.find(':') + 1));
    return {std::istream_iterator<std::string>(words), {}};
  }
  return {};
}

bool has_all(const std::set<std::string>& flags, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (!flags.contains(name)) return false;
  }
  return true;
}

TEST(Processor, HasWhatLinuxFinds) {
  const std::set<std::string> flags = linux_flags();
  if (flags.empty()) GTEST_SKIP() << "no flags in /proc/cpuinfo";
  const bool sse4 = has_all(flags, {"ssse3", "sse4_1", "sse4_2", "popcnt", "pclmulqdq", "aes"});
  const bool avx2 = sse4 && has_all(flags, {"avx", "avx2", "bmi1", "bmi2", "fma", "f16c", "abm"});
  EXPECT_EQ(std::ranges::count(supported_isas(), SOBB_ISA_SSE4) == 1, sse4);
  EXPECT_EQ(std::ranges::count(supported_isas(), SOBB_ISA_AVX2) == 1, avx2);
}

}  // namespace
}  // namespace sobb::test
