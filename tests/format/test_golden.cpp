// SPDX-License-Identifier: Apache-2.0
// Every later library has to read, or refuse, the files of tests/golden as this one does.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sobb/sobb.h"
#include "support/supported_isas.h"

namespace sobb {
namespace {

const std::filesystem::path& golden() {
  static const std::filesystem::path folder =
      std::filesystem::path(SOBB_TEST_DATA).parent_path() / "golden";
  return folder;
}

// The fixed part of a hit: t, u and v by their bits, and the primitive.
struct Answer {
  uint32_t bits[4];
};

Answer answer_of(const sobb_hit& hit) {
  return {{std::bit_cast<uint32_t>(hit.t), std::bit_cast<uint32_t>(hit.u),
           std::bit_cast<uint32_t>(hit.v), hit.primitive}};
}

// Reads lines of eight words of a ray and four of its hit, in hexadecimal.
void read_hits(const std::filesystem::path& path, std::vector<sobb_ray>& rays,
               std::vector<Answer>& answers) {
  std::ifstream file(path);
  uint32_t words[12];
  while (file >> std::hex >> words[0]) {
    for (int i = 1; i < 12; ++i) file >> words[i];
    const auto real = [&](int i) { return std::bit_cast<float>(words[i]); };
    rays.push_back({{real(0), real(1), real(2)}, real(3), {real(4), real(5), real(6)}, real(7)});
    answers.push_back({{words[8], words[9], words[10], words[11]}});
  }
  EXPECT_FALSE(rays.empty()) << path;
}

void expect_hits(const sobb_hierarchy* hierarchy, const std::vector<sobb_ray>& rays,
                 const std::vector<Answer>& answers) {
  // Repeated, they are enough for the kernel of batches.
  std::vector<sobb_ray> many;
  for (int i = 0; i < 8; ++i) many.insert(many.end(), rays.begin(), rays.end());
  std::vector<sobb_hit> hits(many.size());
  for (const sobb_isa isa : test::supported_isas()) {
    for (const uint32_t flags : {0u, static_cast<uint32_t>(SOBB_TRACE_COHERENT)}) {
      for (const size_t count : {rays.size(), many.size()}) {
        sobb_trace_options options = {};
        options.struct_size = sizeof options;
        options.isa = isa;
        options.flags = flags;
        options.threads = 1;
        ASSERT_EQ(sobb_intersect(hierarchy, many.data(), count, hits.data(), &options), SOBB_OK);
        for (size_t i = 0; i < count; ++i) {
          const Answer found = answer_of(hits[i]);
          const Answer& right = answers[i % answers.size()];
          EXPECT_TRUE(std::equal(std::begin(found.bits), std::end(found.bits), right.bits))
              << "ray " << i << " isa " << isa << " flags " << flags;
        }
      }
    }
  }
}

TEST(Golden, GoodFilesGiveTheHitsTheyGave) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(golden() / "good")) {
    if (entry.path().extension() != ".sobb") continue;
    SCOPED_TRACE(entry.path());
    ++files;
    std::vector<sobb_ray> rays;
    std::vector<Answer> answers;
    read_hits(std::filesystem::path(entry.path()).replace_extension(".hits"), rays, answers);
    for (const uint32_t flags : {0u, static_cast<uint32_t>(SOBB_OPEN_MAP)}) {
      sobb_open_options options = {};
      options.struct_size = sizeof options;
      options.flags = flags;
      sobb_hierarchy* hierarchy = nullptr;
      ASSERT_EQ(sobb_open(entry.path().c_str(), &options, &hierarchy), SOBB_OK)
          << sobb_last_error();
      expect_hits(hierarchy, rays, answers);
      sobb_release(hierarchy);
    }
  }
  EXPECT_GE(files, 12);
}

sobb_status status_of(const std::string& name) {
  static const std::map<std::string, sobb_status> statuses = {
      {"MAGIC", SOBB_ERROR_FORMAT_MAGIC},       {"VERSION", SOBB_ERROR_FORMAT_VERSION},
      {"FEATURE", SOBB_ERROR_FORMAT_FEATURE},   {"SIZE", SOBB_ERROR_FORMAT_SIZE},
      {"HEADER", SOBB_ERROR_FORMAT_HEADER},     {"SECTION", SOBB_ERROR_FORMAT_SECTION},
      {"CHECKSUM", SOBB_ERROR_FORMAT_CHECKSUM}, {"TABLE", SOBB_ERROR_FORMAT_TABLE},
      {"NODE", SOBB_ERROR_FORMAT_NODE},         {"REFERENCE", SOBB_ERROR_FORMAT_REFERENCE},
      {"DEPTH", SOBB_ERROR_FORMAT_DEPTH},       {"TRIANGLE", SOBB_ERROR_FORMAT_TRIANGLE},
      {"RECORD", SOBB_ERROR_FORMAT_RECORD},
  };
  return statuses.at(name);
}

TEST(Golden, BadFilesAreRefusedAsTheyWere) {
  std::ifstream expected(golden() / "bad/expected.txt");
  std::string name;
  std::string status;
  std::string message;
  int files = 0;
  while (expected >> name >> status && std::getline(expected >> std::ws, message)) {
    SCOPED_TRACE(name);
    ++files;
    const std::string path = golden() / ("bad/" + name + ".sobb");
    sobb_hierarchy* hierarchy = nullptr;
    EXPECT_EQ(sobb_open(path.c_str(), nullptr, &hierarchy), status_of(status)) << sobb_last_error();
    const std::string said = sobb_last_error();
    EXPECT_EQ(said.find(path + ": "), 0u) << said;
    EXPECT_NE(said.find(message), std::string::npos) << said;
    EXPECT_EQ(hierarchy, nullptr);
  }
  EXPECT_GE(files, 50);
}

}  // namespace
}  // namespace sobb
