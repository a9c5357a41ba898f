// SPDX-License-Identifier: Apache-2.0
// The command line of both benchmark programs: CLI11 parses our flags, Google Benchmark the rest.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace sobb::bench {

/// Adds --scene, --cameras and --view, which say what is traced and from where.
void add_scene_options(CLI::App& app, std::string& scene, std::string& cameras, uint64_t& view);

/// Parses by @p app, whose name is the program's. Returns what Google Benchmark parses: the
/// program, our defaults, the caller's --benchmark_ flags. Prints and exits with 0 for --help, with
/// 2 for a wrong flag or value.
std::vector<std::string> parse_command_line(CLI::App& app, int argc, char** argv);

/// Exits with 2 for a flag that Google Benchmark does not know. It keeps pointers into
/// @p arguments.
void initialize_benchmark(std::vector<std::string>& arguments);

}  // namespace sobb::bench
