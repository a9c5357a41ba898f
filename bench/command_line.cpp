// SPDX-License-Identifier: Apache-2.0
// CLI11 parses our flags and leaves the rest to Google Benchmark.
#include "command_line.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <iostream>

namespace sobb::bench {
namespace {

constexpr int kUsageError = 2;

// Medians of interleaved repetitions make the rows of one run comparable. The caller's flags come
// later on Google Benchmark's command line and win.
const std::vector<std::string> kBenchmarkDefaults{"--benchmark_repetitions=5",
                                                  "--benchmark_enable_random_interleaving=true",
                                                  "--benchmark_display_aggregates_only=true"};

}  // namespace

void add_scene_options(CLI::App& app, std::string& scene, std::string& cameras, uint64_t& view) {
  app.add_option("--scene", scene,
                 "a scene file or builtin:NAME[:TRIANGLES]; ^TIMES refines it, @DEGREES turns it")
      ->capture_default_str();
  app.add_option("--cameras", cameras, "a JSON file of views (see sobb/scene.h)");
  app.add_option("--view", view, "which of the scene's views")->capture_default_str();
}

std::vector<std::string> parse_command_line(CLI::App& app, int argc, char** argv) {
  app.allow_extras();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help() << "\nFlags of Google Benchmark:\n" << std::flush;
    benchmark::PrintDefaultHelp();
    std::exit(0);
  } catch (const CLI::ParseError& error) {
    std::cerr << app.get_name() << ": " << error.what() << "\n" << app.help();
    std::exit(kUsageError);
  }

  std::vector<std::string> arguments{argv[0]};
  arguments.insert(arguments.end(), kBenchmarkDefaults.begin(), kBenchmarkDefaults.end());
  for (const std::string& extra : app.remaining()) {
    if (!extra.starts_with("--benchmark_")) {
      std::cerr << app.get_name() << ": unknown argument " << extra << "\n" << app.help();
      std::exit(kUsageError);
    }
    arguments.push_back(extra);
  }
  return arguments;
}

void initialize_benchmark(std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  int argc = static_cast<int>(argv.size());
  argv.push_back(nullptr);
  benchmark::Initialize(&argc, argv.data());
  if (benchmark::ReportUnrecognizedArguments(argc, argv.data())) std::exit(kUsageError);
}

}  // namespace sobb::bench
