// SPDX-License-Identifier: Apache-2.0
// Checks that bytes and hits do not depend on threads and instruction sets, and prints a hash for
// each scene and choice of options, as tests/determinism/hashes.txt has them. So builds by
// different compilers can be compared.
//
// usage: sobb_hashes RAYS [TABLE]   RAYS per scene; compares with TABLE instead of printing

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/xxh3.h"
#include "determinism/scenes.h"
#include "determinism/ways.h"
#include "support/more_threads.h"

namespace sobb::test {
namespace {

std::string quality_name(uint32_t quality) {
  if (quality == SOBB_QUALITY_LOW) return "low";
  return quality == SOBB_QUALITY_MEDIUM ? "medium" : "high";
}

std::string hash_of(const void* data, uint64_t size) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, static_cast<uint64_t>(XXH3_64bits(data, size)));
  return text;
}

// "SCENE bytes VOLUME kK wWIDTH QUALITY HASH" and "SCENE hits RAYS HASH".
std::vector<std::string> make_rows(uint32_t rays) {
  std::vector<std::string> rows;
  for (const Soup& scene : determinism_scenes()) {
    std::vector<Handle> hierarchies;
    for (const uint32_t quality : {SOBB_QUALITY_LOW, SOBB_QUALITY_MEDIUM, SOBB_QUALITY_HIGH}) {
      for (const Shape& shape : kShapes) {
        hierarchies.push_back(build_every_way(scene, shape, quality));
        const std::string_view bytes = bytes_of(hierarchies.back());
        rows.push_back(scene.name + " bytes " +
                       (shape.volume == SOBB_VOLUME_AABB ? "aabb" : "sobb") + " k" +
                       std::to_string(shape.k) + " w" + std::to_string(shape.width) + " " +
                       quality_name(quality) + " " + hash_of(bytes.data(), bytes.size()));
      }
    }
    const std::vector<sobb_hit> hits = trace_every_way(scene, hierarchies, rays);
    rows.push_back(scene.name + " hits " + std::to_string(rays) + " " +
                   hash_of(hits.data(), hits.size() * sizeof hits[0]));
  }
  return rows;
}

// Counts the rows that the table has otherwise, or not at all.
int compare(const std::vector<std::string>& rows, const char* path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(std::string(path) + ": cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  int different = 0;
  for (const std::string& row : rows) {
    if (text.find(row + "\n") != std::string::npos) continue;
    std::cerr << "not in the table: " << row << "\n";
    ++different;
  }
  std::cout << rows.size() << " hashes, " << different << " differ\n";
  return different;
}

}  // namespace
}  // namespace sobb::test

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: sobb_hashes RAYS [TABLE]\n";
    return 2;
  }
  const sobb::test::MoreThreads more(8);
  try {
    const auto rows =
        sobb::test::make_rows(static_cast<uint32_t>(std::strtoul(argv[1], nullptr, 10)));
    if (argc == 3) return sobb::test::compare(rows, argv[2]) == 0 ? 0 : 1;
    for (const std::string& row : rows) std::cout << row << "\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
