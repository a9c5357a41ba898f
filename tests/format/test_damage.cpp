// SPDX-License-Identifier: Apache-2.0
// A file with any byte missing, added or changed is refused, or safe to walk.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "format/small_file.h"

namespace sobb {
namespace {

using test::error_of;
using test::SmallFile;

std::vector<SmallFile> small_files() {
  std::vector<SmallFile> files;
  for (const sobb_volume volume : {SOBB_VOLUME_AABB, SOBB_VOLUME_SOBB}) {
    for (const uint32_t width : {4u, 8u}) files.push_back(test::make_small_file(volume, width));
  }
  return files;
}

// Calls body with every byte of the file changed in turn: with each bit flipped, with all bits
// flipped, and with the values at the ends of the range.
template <class Body>
void for_each_change(SmallFile& file, Body body) {
  for (size_t at = 0; at < file.bytes().size(); ++at) {
    const std::byte old = file.bytes()[at];
    const auto change = [&](std::byte changed) {
      if (changed == old) return;
      Image damaged = test::copy_of(file.bytes());
      damaged.bytes()[at] = changed;
      body(damaged.bytes(), at);
    };
    for (int bit = 0; bit < 8; ++bit) change(old ^ (std::byte{1} << bit));
    for (const int value : {0x00, 0x7F, 0x80, 0xFF}) change(static_cast<std::byte>(value));
    change(~old);
  }
}

TEST(FormatDamage, TruncationAnywhereIsRefused) {
  for (SmallFile& file : small_files()) {
    for (size_t size = 0; size < file.bytes().size(); ++size) {
      const Image part = test::copy_of(file.bytes().first(size));
      const auto error = error_of(part.bytes());
      ASSERT_TRUE(error) << size;
      EXPECT_EQ(error->status, SOBB_ERROR_FORMAT_SIZE) << size << ": " << error->what();
    }
  }
}

TEST(FormatDamage, TruncationIsRefusedThoughTheSizeIsCorrected) {
  for (SmallFile& file : small_files()) {
    for (size_t size = sizeof(FileHeader); size < file.bytes().size(); ++size) {
      Image part = test::copy_of(file.bytes().first(size));
      reinterpret_cast<FileHeader*>(part.bytes().data())->total_size = size;
      test::reseal(part.bytes());
      EXPECT_TRUE(error_of(part.bytes())) << size;
    }
  }
}

TEST(FormatDamage, ExtensionIsRefused) {
  for (SmallFile& file : small_files()) {
    for (const size_t more : {size_t{1}, size_t{64}, size_t{100000}}) {
      Image longer = Image::allocate(std::make_shared<Memory>(), file.bytes().size() + more);
      std::ranges::copy(file.bytes(), longer.bytes().begin());
      const auto error = error_of(longer.bytes());
      ASSERT_TRUE(error);
      EXPECT_EQ(error->status, SOBB_ERROR_FORMAT_SIZE) << error->what();
    }
  }
}

TEST(FormatDamage, EveryChangedByteIsNoticed) {
  for (SmallFile& file : small_files()) {
    for_each_change(file, [](std::span<std::byte> damaged, size_t at) {
      ASSERT_TRUE(error_of(damaged)) << "byte " << at;
    });
  }
}

TEST(FormatDamage, ChangesWithChecksumsRecomputedAreSafe) {
  for (SmallFile& file : small_files()) {
    size_t opened = 0;
    for_each_change(file, [&](std::span<std::byte> damaged, size_t) {
      test::reseal(damaged);
      if (!error_of(damaged)) ++opened;
    });
    EXPECT_GT(opened, 0u);  // a vertex may move, for instance
  }
}

// Changes several words at once, to values that fields hold.
TEST(FormatDamage, RandomWordsAreSafe) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  constexpr uint32_t kValues[] = {0, 1, 2, 3, 4, 64, 0xFFFFFFFF, 0x7F800000, 0x80000000, 0x8001};
  auto files = small_files();
  for (int round = 0; round < 20000; ++round) {
    SmallFile& file = files[random() % files.size()];
    Image damaged = test::copy_of(file.bytes());
    auto* const words = reinterpret_cast<uint32_t*>(damaged.bytes().data());
    const size_t count = damaged.bytes().size() / sizeof *words;
    for (uint32_t changes = 1 + random() % 4; changes > 0; --changes) {
      const uint32_t value =
          random() % 4 ? kValues[random() % std::size(kValues)] : static_cast<uint32_t>(random());
      words[random() % count] = value;
    }
    test::reseal(damaged.bytes());
    error_of(damaged.bytes());
  }
}

TEST(FormatDamage, RandomBytesAreRefused) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::byte> noise(random() % 1000);
    for (std::byte& b : noise) b = static_cast<std::byte>(random());
    // Half of the files get past the first checks.
    if (round % 2 != 0 && noise.size() >= sizeof(FileHeader)) {
      auto& header = *reinterpret_cast<FileHeader*>(noise.data());
      std::ranges::copy(kMagic, header.magic);
      header.version = kFormatVersion;
      header.header_size = sizeof(FileHeader);
      header.total_size = noise.size();
      header.section_count = static_cast<uint32_t>(random() % 8);
      header.must_understand = 0;
    }
    Image image = test::copy_of(noise);
    test::reseal(image.bytes());
    if (!noise.empty()) {
      EXPECT_TRUE(error_of(image.bytes()));
    }
  }
}

}  // namespace
}  // namespace sobb
