// SPDX-License-Identifier: Apache-2.0
// Declares the flags for CLI11.
#include "bench_volumes/options.h"

#include <CLI/CLI.hpp>
#include <map>

#include "check.h"
#include "command_line.h"
#include "isa_flags.h"

namespace sobb::bench::volumes {
namespace {

/// Adds a flag whose value is one of a few words.
template <typename T>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, T& target,
                        const std::map<std::string, T>& choices, const std::string& help) {
  const auto choose = [&target, choices](const std::string& word) { target = choices.at(word); };
  return app.add_option_function<std::string>(flag, choose, help)->check(CLI::IsMember(choices));
}

void add_options(CLI::App& app, Options& options) {
  add_scene_options(app, options.scene, options.cameras, options.view);
  app.add_option("--size", options.size, "trace SIZE x SIZE primary rays and their paths")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads of every build and trace")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--cell-seconds", options.cell_seconds, "time for the repetitions of a row")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  std::map<std::string, sobb_isa> isas;
  for (const std::string& name : isa_choices())
    check(sobb_isa_from_name(name.c_str(), &isas[name]));
  add_choice(app, "--isa", options.isa, isas, "the kernels (default: best)");
  add_choice(app, "--strategy", options.strategies,
             {{"k", {SOBB_STRATEGY_K}},
              {"k2", {SOBB_STRATEGY_K2}},
              {"k3", {SOBB_STRATEGY_K3}},
              {"all", {SOBB_STRATEGY_K, SOBB_STRATEGY_K2, SOBB_STRATEGY_K3}}},
             "of SOBB 32, 48 and 64: k, k2 (default), k3 or all; 128 and 256 take k2");
  add_choice(app, "--layout", options.widths, {{"binary", {2}}, {"wide", {8}}, {"both", {2, 8}}},
             "nodes of two children, of eight, or both (default)");
}

}  // namespace

Options parse_options(int argc, char** argv) {
  Options options;
  CLI::App app{"Traces the same rays through hierarchies of every bounding volume.",
               "sobb_bench_volumes"};
  add_options(app, options);
  options.benchmark_arguments = parse_command_line(app, argc, argv);
  return options;
}

}  // namespace sobb::bench::volumes
