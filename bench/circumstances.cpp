// SPDX-License-Identifier: Apache-2.0
// The system and the libraries say where and by what a run measures.
#include "circumstances.h"

#include <fstream>

#include "check.h"

namespace sobb::bench {

std::string processor() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string isa_name(sobb_isa isa) {
  sobb_isa resolved = SOBB_ISA_BEST;
  check(sobb_resolve_isa(isa, &resolved));
  return sobb_isa_name(resolved);
}

std::string strategy_name(uint32_t strategy) {
  return strategy == SOBB_STRATEGY_K ? "k" : strategy == SOBB_STRATEGY_K3 ? "k3" : "k2";
}

std::string library_version() {
  const uint32_t version = sobb_version();
  return std::to_string(version >> 16) + "." + std::to_string(version >> 8 & 0xFF) + "." +
         std::to_string(version & 0xFF);
}

}  // namespace sobb::bench
