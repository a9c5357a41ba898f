// SPDX-License-Identifier: Apache-2.0
// What both programs do with a command line: our flags are CLI11's, the rest Google Benchmark's.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace sobb::bench {

/// Parses by @p app, whose name is the program's. Returns what Google Benchmark shall parse: the
/// program, our defaults, the caller's --benchmark_ flags. Prints and exits with 0 for --help, with
/// 2 for a wrong flag or value.
std::vector<std::string> parse_command_line(CLI::App& app, int argc, char** argv);

/// Exits with 2 for a flag that Google Benchmark does not know. It keeps pointers into
/// @p arguments.
void initialize_benchmark(std::vector<std::string>& arguments);

}  // namespace sobb::bench
