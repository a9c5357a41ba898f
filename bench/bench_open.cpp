// SPDX-License-Identifier: Apache-2.0
// The rows open/sobb/private and open/sobb/mapped open and validate a saved file that lies in the
// page cache.
#include "check.h"
#include "rows.h"
#include "stopwatch.h"

namespace sobb::bench {
namespace {

void open_file(benchmark::State& state, Workbench& workbench, uint32_t open_flags) {
  const std::string path = workbench.saved_file().string();
  sobb_open_options options = SOBB_OPEN_OPTIONS_INIT;
  options.flags = open_flags;
  options.threads = workbench.flags().threads;
  const Stopwatch clock(options.threads);
  for ([[maybe_unused]] auto _ : state) {
    sobb_hierarchy* hierarchy = nullptr;
    state.SetIterationTime(
        clock.seconds_of([&] { check(sobb_open(path.c_str(), &options, &hierarchy)); }));
    sobb_release(hierarchy);
  }
  const auto bytes = static_cast<int64_t>(std::filesystem::file_size(path));
  state.SetBytesProcessed(state.iterations() * bytes);
}

}  // namespace

void register_open_rows(Workbench& workbench) {
  register_row("open/sobb/private",
               [&workbench](benchmark::State& state) { open_file(state, workbench, 0); });
  register_row("open/sobb/mapped", [&workbench](benchmark::State& state) {
    open_file(state, workbench, SOBB_OPEN_MAP);
  });
}

}  // namespace sobb::bench
