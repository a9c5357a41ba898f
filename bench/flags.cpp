// SPDX-License-Identifier: Apache-2.0
// Declares the flags for CLI11.
#include "flags.h"

#include <CLI/CLI.hpp>
#include <map>

#include "command_line.h"
#include "isa_flags.h"

namespace sobb::bench {
namespace {

CLI::CheckedTransformer names(const std::map<std::string, uint32_t>& values) {
  return CLI::CheckedTransformer(values, CLI::ignore_case);
}

void add_flags(CLI::App& app, Flags& flags) {
  add_scene_options(app, flags.scene, flags.cameras, flags.view);
  app.add_option("--size", flags.size, "trace SIZE x SIZE primary rays")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  app.add_option("--k", flags.k, "planes of the k-DOP")
      ->check(CLI::IsMember({32, 48, 64}))
      ->capture_default_str();
  app.add_option("--quality", flags.quality,
                 "quality of aabb and sobb: low, medium (default) or high")
      ->transform(names({{"low", SOBB_QUALITY_LOW},
                         {"medium", SOBB_QUALITY_MEDIUM},
                         {"high", SOBB_QUALITY_HIGH}}));
  app.add_option("--strategy", flags.strategy, "search for a basis: k, k2 (default) or k3")
      ->transform(
          names({{"k", SOBB_STRATEGY_K}, {"k2", SOBB_STRATEGY_K2}, {"k3", SOBB_STRATEGY_K3}}));
  app.add_option("--table", flags.table, "direction table of SOBBs: spread or fitted (default)")
      ->transform(names({{"spread", SOBB_TABLE_SPREAD}, {"fitted", SOBB_TABLE_FITTED}}));
  app.add_option("--width", flags.width, "children per node")
      ->check(CLI::IsMember({4, 8}))
      ->capture_default_str();
  app.add_option("--threads", flags.threads, "threads of every build and trace, Embree's too")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--isa", flags.isa, "our kernels")
      ->check(CLI::IsMember(isa_choices()))
      ->capture_default_str();
  app.add_option("--embree-isa", flags.embree_isa,
                 "Embree's device option isa, e.g. sse4.2, avx2; same: the set of our kernels");
}

}  // namespace

Flags parse_flags(int argc, char** argv) {
  Flags flags;
  CLI::App app{"Builds, opens and traces SOBB hierarchies beside Embree on the same rays.",
               "sobb_bench"};
  add_flags(app, flags);
  flags.benchmark_arguments = parse_command_line(app, argc, argv);
  return flags;
}

}  // namespace sobb::bench
