// SPDX-License-Identifier: Apache-2.0
// The command line of sobb_study, and its subcommands, each a question of docs/study.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sobb::study {

struct StudyOptions {
  std::vector<std::string> scenes;      // as sobb_scene_load() takes them
  std::vector<std::string> directions;  // files of direction tables, lines `x y z`
  std::string out;                      // the file for the JSON; empty: standard output
  uint32_t threads = 0;                 // 0: as many as TBB gives
  uint32_t size = 128;                  // one path for each of size x size pixels
  uint32_t nodes = 10000;               // sampled per scene
  uint32_t optimised_nodes = 1000;      // per kind, to find free normals for
};

// Each function writes its JSON and returns the program's exit code. They throw sobb::Error and
// std::runtime_error.
int areas(const StudyOptions& options);
int tables(const StudyOptions& options);
int clipping(const StudyOptions& options);
int sharing(const StudyOptions& options);
int topologies(const StudyOptions& options);

}  // namespace sobb::study
