// SPDX-License-Identifier: Apache-2.0
// add_context() fills the report's context, so that a file of results says what it measured.
#include "context.h"

#include <benchmark/benchmark.h>

#include <string>

#include "circumstances.h"

namespace sobb::bench {
namespace {

std::string quality_name(uint32_t quality) {
  return quality == SOBB_QUALITY_LOW ? "low" : quality == SOBB_QUALITY_HIGH ? "high" : "medium";
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
  add("table", flags.table == SOBB_TABLE_FITTED ? "fitted" : "spread");
  add("width", std::to_string(flags.width));
  add("threads", std::to_string(flags.threads));
  add("clock", flags.threads == 1 ? "processor time" : "wall");
  add("isa", isa_name(SOBB_ISA_BEST));
  add("sobb", library_version());
  add("embree", peer_library() == nullptr ? "none" : peer_library()->version);
  add("embree_isa", flags.embree_isa.empty() ? "best" : flags.embree_isa);
  add("processor", processor());
}

}  // namespace sobb::bench
