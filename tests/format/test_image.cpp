// SPDX-License-Identifier: Apache-2.0
// Images read and map files, and refuse what is no file or too large.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <new>
#include <string>

#include "format/reader/reader.h"
#include "format/small_file.h"
#include "format/temporary_folder.h"

namespace sobb {
namespace {

using test::TemporaryFolder;

std::string error_message(sobb_status status, const std::function<void()>& body) {
  try {
    body();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.status, status) << error.what();
    return error.what();
  }
  return "";
}

bool aligned(const Image& image) {
  return reinterpret_cast<uintptr_t>(image.bytes().data()) % kSectionAlignment == 0;
}

TEST(Image, AllocatesZeros) {
  const auto memory = std::make_shared<Memory>();
  {
    Image image = Image::allocate(memory, 1000);
    EXPECT_TRUE(aligned(image));
    EXPECT_EQ(std::ranges::count(image.bytes(), std::byte{0}), 1000);
    EXPECT_EQ(memory->held(), 1000u);
    Image moved = std::move(image);
    image = Image::allocate(memory, 10);
    EXPECT_EQ(memory->held(), 1010u);
    moved = Image();
  }
  EXPECT_EQ(memory->held(), 0u);
}

Image read(std::shared_ptr<Memory> memory, const std::string& path) {
  Progress progress(nullptr, nullptr);
  return Image::read(std::move(memory), path.c_str(), progress, 1);
}

TEST(Image, ReadsAndMapsTheSame) {
  const TemporaryFolder folder;
  test::SmallFile file = test::make_small_file(SOBB_VOLUME_SOBB, 8);
  save_atomically(file.bytes(), folder.path("scene.sobb").c_str());
  const auto memory = std::make_shared<Memory>();
  const Image copy = read(memory, folder.path("scene.sobb"));
  const Image mapped = Image::map(folder.path("scene.sobb").c_str());
  for (const Image* image : {&copy, &mapped}) {
    EXPECT_TRUE(aligned(*image));
    EXPECT_TRUE(std::ranges::equal(image->bytes(), file.bytes()));
    EXPECT_FALSE(test::error_of(image->bytes()));
  }
  EXPECT_EQ(memory->held(), file.bytes().size());
}

TEST(Image, AnEmptyFileHasNoBytes) {
  const TemporaryFolder folder;
  const std::string path = folder.write("empty", "");
  EXPECT_TRUE(Image::map(path.c_str()).bytes().empty());
  const Image image = read(std::make_shared<Memory>(), path);
  EXPECT_TRUE(image.bytes().empty());
  const auto error = test::error_of(image.bytes());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->status, SOBB_ERROR_FORMAT_SIZE);
}

TEST(Image, WhatIsNoFileIsNotOpened) {
  const TemporaryFolder folder;
  const std::string fifo = folder.path("fifo");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  struct Case {
    std::string path, cause;
  };
  const Case cases[] = {
      {folder.path("missing"), "No such file or directory"},
      {folder.path(""), "Is a directory"},
      {fifo, "not a regular file"},
      {"/dev/null", "not a regular file"},
  };
  for (const Case& c : cases) {
    const std::string expected = c.path + ": " + c.cause;
    EXPECT_EQ(
        error_message(SOBB_ERROR_FILE_OPEN, [&] { read(std::make_shared<Memory>(), c.path); }),
        expected);
    EXPECT_EQ(error_message(SOBB_ERROR_FILE_OPEN, [&] { Image::map(c.path.c_str()); }), expected);
  }
}

TEST(Image, ReadingKeepsTheMemoryLimit) {
  const TemporaryFolder folder;
  const std::string path = folder.write("large", std::string(1000, 'x'));
  const auto memory = std::make_shared<Memory>(nullptr, 999);
  error_message(SOBB_ERROR_MEMORY_LIMIT, [&] { read(memory, path); });
  EXPECT_EQ(memory->held(), 0u);
}

// A sparse file of 4 TiB takes no room on the disk, but is larger than the memory.
TEST(Image, AHugeFileIsRefusedBeforeItIsRead) {
  const TemporaryFolder folder;
  const std::string path = folder.write("sparse", "");
  std::error_code error;
  std::filesystem::resize_file(path, uint64_t{1} << 42, error);
  if (error) GTEST_SKIP() << "this file system has no files of 4 TiB: " << error.message();
  const auto memory = std::make_shared<Memory>(nullptr, uint64_t{1} << 30);
  error_message(SOBB_ERROR_MEMORY_LIMIT, [&] { read(memory, path); });
  EXPECT_EQ(memory->held(), 0u);
}

}  // namespace
}  // namespace sobb
