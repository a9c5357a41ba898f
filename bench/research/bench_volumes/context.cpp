// SPDX-License-Identifier: Apache-2.0
// add_context() fills the report's context, so that a file of results says what it measured.
#include "bench_volumes/context.h"

#include <benchmark/benchmark.h>

#include "circumstances.h"

namespace sobb::bench::volumes {

void add_context(const Workbench& workbench) {
  const Options& options = workbench.options();
  const auto add = [](const char* key, const std::string& value) {
    benchmark::AddCustomContext(key, value);
  };
  add("scene", options.scene);
  add("triangles", std::to_string(workbench.scene().info().triangle_count));
  add("view", std::to_string(options.view));
  add("size", std::to_string(options.size));
  add("threads", std::to_string(options.threads));
  add("isa", isa_name(options.isa));
  for (const RayGroup& group : workbench.groups()) {
    benchmark::AddCustomContext(group.name + "_rays", std::to_string(group.rays.size()));
  }
  add("brute_force_rays", std::to_string(workbench.brute_force_rays()));
  add("sobb", library_version());
  add("processor", processor());
}

}  // namespace sobb::bench::volumes
