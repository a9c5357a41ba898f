// SPDX-License-Identifier: Apache-2.0
// Runs a target over files, without libFuzzer, with any compiler:
//   fuzz_replay TARGET FILE-OR-FOLDER...
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/targets.h"

namespace {

namespace fs = std::filesystem;

const sobb::fuzz::Target* find_target(const char* name) {
  for (const sobb::fuzz::Target& target : sobb::fuzz::kTargets) {
    if (std::strcmp(target.name, name) == 0) return &target;
  }
  return nullptr;
}

void collect(const fs::path& path, std::vector<fs::path>& files) {
  if (!fs::is_directory(path)) {
    files.push_back(path);
    return;
  }
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path());
}

// A copy of just the file's size, so that a sanitizer sees any byte read beyond it.
std::vector<char> read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return {text.begin(), text.end()};
}

}  // namespace

int main(int argc, char** argv) {
  const sobb::fuzz::Target* target = argc > 2 ? find_target(argv[1]) : nullptr;
  if (target == nullptr) {
    std::fputs("usage: fuzz_replay TARGET FILE-OR-FOLDER...\n", stderr);
    return 2;
  }
  std::vector<fs::path> files;
  for (int i = 2; i < argc; ++i) collect(argv[i], files);
  for (const fs::path& file : files) {
    std::fprintf(stderr, "%s\n", file.c_str());  // so that a crash shows its file
    const std::vector<char> bytes = read(file);
    target->run(std::as_bytes(std::span(bytes)));
  }
  std::printf("%s: %zu inputs\n", target->name, files.size());
  return files.empty() ? 1 : 0;
}
