// SPDX-License-Identifier: Apache-2.0
// sobb_study answers questions about bounding volumes. Its exit code is 0 when the question is
// answered, 1 when not, 2 for wrong usage.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "study/study_options.h"

namespace {

using namespace sobb::study;

constexpr int kUsageError = 2;

struct Question {
  const char* name;
  const char* text;
  int (*answer)(const StudyOptions& options);
};

constexpr Question kQuestions[] = {
    {"areas", "how far are the volumes' areas from the least?", areas},
    {"tables", "what does another direction table bring?", tables},
    {"clipping", "would clipping a child with its parent's interval pay?", clipping},
    {"sharing", "what does a basis shared by a node's children lose?", sharing},
    {"topologies", "are hierarchies built for AABBs the right ones?", topologies},
};

void add_options(CLI::App& app, StudyOptions& options) {
  app.add_option("--scene", options.scenes,
                 "a scene file or builtin:NAME[:TRIANGLES]; ^TIMES refines it, @DEGREES turns it")
      ->required();
  app.add_option("--directions", options.directions,
                 "a file of unit vectors, one line `x y z` per vector");
  app.add_option("--out", options.out, "write the JSON to this file, not to standard output");
  app.add_option("--threads", options.threads, "threads; 0: all")->capture_default_str();
  app.add_option("--size", options.size, "trace one path for each of SIZE x SIZE pixels")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  app.add_option("--nodes", options.nodes, "nodes to sample per scene")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  app.add_option("--optimised-nodes", options.optimised_nodes,
                 "nodes of each kind to find free normals for")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Questions about bounding volumes and their hierarchies, answered with figures.");
  app.require_subcommand(1);
  app.fallthrough();
  StudyOptions options;
  add_options(app, options);
  int (*answer)(const StudyOptions&) = nullptr;
  for (const Question& question : kQuestions) {
    app.add_subcommand(question.name, question.text)->callback([&] { answer = question.answer; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  try {
    return answer(options);
  } catch (const std::exception& error) {
    std::cerr << "sobb_study: " << error.what() << "\n";
    return 1;
  }
}
