// SPDX-License-Identifier: Apache-2.0
// Fills the report's context, so that a file of results says what it measured.
#include "context.h"

#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

#include "check.h"

namespace sobb::bench {
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

std::string resolved_isa() {
  sobb_isa isa = SOBB_ISA_BEST;
  check(sobb_resolve_isa(SOBB_ISA_BEST, &isa));
  return isa == SOBB_ISA_SSE4 ? "sse4" : "avx2";
}

std::string quality_name(uint32_t quality) {
  return quality == SOBB_QUALITY_LOW ? "low" : quality == SOBB_QUALITY_HIGH ? "high" : "medium";
}

std::string strategy_name(uint32_t strategy) {
  return strategy == SOBB_STRATEGY_K ? "k" : strategy == SOBB_STRATEGY_K3 ? "k3" : "k2";
}

}  // namespace

void add_context(const Workbench& workbench) {
  const Flags& flags = workbench.flags();
  const auto add = [](const char* key, const std::string& value) {
    benchmark::AddCustomContext(key, value);
  };
  add("scene", flags.scene);
  add("triangles", std::to_string(workbench.scene().info().triangle_count));
  add("view", std::to_string(flags.view));
  add("size", std::to_string(flags.size));
  add("k", std::to_string(flags.k));
  add("quality", quality_name(flags.quality));
  add("strategy", strategy_name(flags.strategy));
  add("width", std::to_string(flags.width));
  add("threads", std::to_string(flags.threads));
  add("clock", flags.threads == 1 ? "processor time" : "wall");
  add("isa", resolved_isa());
  add("sobb", library_version());
  add("embree", embree_version());
  add("embree_isa", flags.embree_isa.empty() ? "best" : flags.embree_isa);
  add("embree_robust", flags.embree_robust ? "yes" : "no");
  add("processor", processor());
}

}  // namespace sobb::bench
