// SPDX-License-Identifier: Apache-2.0
// Valid files open, and show what was written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "format/checksum.h"
#include "format/reader/reader.h"
#include "format/small_file.h"

namespace sobb {
namespace {

using test::SmallFile;

class Format : public testing::TestWithParam<std::tuple<sobb_volume, uint32_t>> {
 protected:
  SmallFile file_ = test::make_small_file(std::get<0>(GetParam()), std::get<1>(GetParam()));
};

INSTANTIATE_TEST_SUITE_P(VolumesAndWidths, Format,
                         testing::Combine(testing::Values(SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB),
                                          testing::Values(4u, 8u)));

TEST_P(Format, OpensAndShowsWhatWasWritten) {
  const Scheduler scheduler(0, nullptr);
  Memory scratch;
  Progress progress(nullptr, nullptr);
  const FileView view = read_image(file_.bytes(), "scene.sobb", scheduler, scratch, progress);
  EXPECT_EQ(view.header, &file_.header());
  EXPECT_EQ(view.directions.data(), file_.parts.directions.data());
  EXPECT_EQ(view.directions.size(), file_.parts.directions.size());
  EXPECT_EQ(view.nodes, file_.parts.nodes);
  EXPECT_EQ(view.node_count, 3u);
  EXPECT_EQ(view.blocks.data(), file_.parts.blocks.data());
  EXPECT_EQ(view.blocks.size(), 5u);
  EXPECT_EQ(view.record, file_.parts.record);
  EXPECT_EQ(view.record->reference_count, 12u);
  EXPECT_FALSE(test::error_of(file_.bytes()));
  EXPECT_EQ(scratch.held(), 0u);
}

TEST_P(Format, SectionsAreAlignedAndInTheOrderOfTheDocument) {
  const auto sections = file_.sections();
  ASSERT_EQ(sections.size(), 4u);
  constexpr SectionId kOrder[] = {SectionId::kDirections, SectionId::kRecord, SectionId::kNodes,
                                  SectionId::kBlocks};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(sections[i].id, static_cast<uint32_t>(kOrder[i]));
    EXPECT_EQ(sections[i].offset % kSectionAlignment, 0u);
  }
  EXPECT_EQ(sections[3].offset + sections[3].size, file_.bytes().size());
}

TEST_P(Format, SealingTwiceChangesNothing) {
  const Image before = test::copy_of(file_.bytes());
  finish_image(file_.image, file_.shape, file_.fields, Scheduler(3, nullptr));
  EXPECT_TRUE(std::ranges::equal(before.bytes(), file_.bytes()));
}

TEST(FormatChecksum, DependsOnEveryMebibyteAndNotOnTheThreads) {
  std::vector<std::byte> bytes(3 * kChecksumChunk + 17);
  auto& scratch = *std::pmr::get_default_resource();
  const auto checksum = [&](uint32_t threads) {
    return section_checksum(bytes, Scheduler(threads, nullptr), scratch);
  };
  const uint64_t zeros = checksum(1);
  EXPECT_EQ(checksum(3), zeros);
  for (size_t at = 0; at < bytes.size(); at += kChecksumChunk - 1) {
    bytes[at] = std::byte{1};
    EXPECT_NE(checksum(3), zeros) << at;
    bytes[at] = std::byte{0};
  }
  EXPECT_EQ(section_checksum({}, Scheduler(1, nullptr), scratch), 0x2D06800538D394C2u);
}

TEST(FormatSections, UnknownOnesArePassedOverButChecked) {
  // The smallest file gets a fifth section of 64 bytes; the table grows by 32 bytes, into the gap.
  SmallFile file = test::make_smallest_file();
  const size_t old_size = file.bytes().size();
  const size_t offset = (old_size + 63) / 64 * 64;
  // The directions follow the table at once, so all sections move up by 64.
  Image image = Image::allocate(std::make_shared<Memory>(), 64 + offset + 64);
  const auto to = image.bytes();
  std::ranges::copy(file.bytes().first(256), to.begin());
  std::ranges::copy(file.bytes().subspan(256), to.begin() + 320);
  auto& header = *reinterpret_cast<FileHeader*>(to.data());
  auto* sections = reinterpret_cast<Section*>(to.data() + sizeof(FileHeader));
  for (int i = 0; i < 4; ++i) sections[i].offset += 64;
  sections[4] = {1000, 0, 64 + offset, 64, 0};
  header.section_count = 5;
  header.total_size = to.size();
  test::reseal(to);
  EXPECT_FALSE(test::error_of(to));

  to.back() = std::byte{1};
  const auto error = test::error_of(to);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->status, SOBB_ERROR_FORMAT_CHECKSUM);
  EXPECT_NE(std::string(error->what()).find("id 1000"), std::string::npos) << error->what();
}

TEST(FormatHeader, IgnorableFeaturesAreIgnored) {
  SmallFile file = test::make_smallest_file();
  file.header().ignorable = 0x80000001;
  file.seal();
  EXPECT_FALSE(test::error_of(file.bytes()));
}

TEST(FormatTree, TheDeepestAllowedOpens) {
  EXPECT_FALSE(test::error_of(test::make_chain(kMaxDepth).bytes()));
}

// The hex dump in docs/format.md: lines of an offset and sixteen bytes.
TEST(FormatDocument, ShowsTheSmallestFile) {
  const auto tests = std::filesystem::path(SOBB_TEST_DATA).parent_path();
  std::ifstream document(tests.parent_path() / "docs/format.md");
  ASSERT_TRUE(document) << "docs/format.md is missing";
  std::vector<std::byte> example;
  for (std::string line; std::getline(document, line);) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word.size() != 6 || line.rfind("0x", 0) != 0) continue;
    ASSERT_EQ(std::strtoul(word.c_str(), nullptr, 16), example.size()) << line;
    for (int i = 0; i < 16 && words >> word; ++i) {
      example.push_back(static_cast<std::byte>(std::strtoul(word.c_str(), nullptr, 16)));
    }
  }
  EXPECT_TRUE(std::ranges::equal(example, test::make_smallest_file().bytes()));
}

}  // namespace
}  // namespace sobb
