// SPDX-License-Identifier: Apache-2.0
// What the tests of all readers share: reading from memory, expected errors, hostile bytes.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "scene/error_testing.h"
#include "scene/formats.h"
#include "scene/model/scene_writer.h"

namespace sobb::reader_testing {

// The path of what is read from memory: nothing is beside it.
inline const std::string kPath = "no such folder/scene";

inline Scene read_scene(FormatReader reader, std::string_view bytes) {
  // A copy of just that size, so that a sanitizer sees any byte read beyond it.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  Scene scene;
  SceneWriter writer(kPath, 0, scene);
  reader({exact.data(), exact.size()}, writer);
  writer.finish();
  return scene;
}

using Indices = std::vector<uint32_t>;

// Expects an error whose message has `part` and begins with the file's path.
inline void expect_error(FormatReader reader, std::string_view bytes, sobb_status status,
                         const std::string& part) {
  SCOPED_TRACE(std::string(bytes.substr(0, 400)));
  const std::string message =
      test::expect_failure(status, part, [&] { read_scene(reader, bytes); });
  EXPECT_TRUE(message.starts_with(kPath + ": ")) << message;
}

// The scene's notes, as "cause, count, text".
inline std::vector<std::string> notes_of(const Scene& scene) {
  std::vector<std::string> notes;
  for (const SceneNote& note : scene.notes) {
    notes.push_back(std::to_string(note.cause) + ", " + std::to_string(note.count) + ", " +
                    note.first);
  }
  return notes;
}
using Notes = std::vector<std::string>;

// Twice the sum of the triangles' areas.
inline double double_area(const Scene& scene) {
  double sum = 0;
  for (size_t i = 0; i < scene.indices.size(); i += 3) {
    const auto corner = [&](size_t k) { return widen(&scene.vertices[3 * scene.indices[i + k]]); };
    sum += length(cross(corner(1) - corner(0), corner(2) - corner(0)));
  }
  return sum;
}

// Reads bytes that may be anything, and expects a scene whose indices are in range or an Error.
// Returns whether it was a scene.
inline bool read_hostile(FormatReader reader, std::string_view bytes) {
  try {
    const Scene scene = read_scene(reader, bytes);
    for (const uint32_t index : scene.indices) EXPECT_LT(index, scene.vertices.size() / 3);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// Reads a good file truncated at every byte, and with every byte changed: each of its bits, and to
// characters that mean something to one format or another.
inline void check_damaged(FormatReader reader, const std::string& good) {
  ASSERT_TRUE(read_hostile(reader, good));
  for (size_t size = 0; size < good.size(); ++size) {
    read_hostile(reader, std::string_view(good).substr(0, size));
  }
  std::string bytes = good;
  for (char& byte : bytes) {
    const char kept = byte;
    for (int bit = 0; bit < 8; ++bit) {
      byte = static_cast<char>(kept ^ (1 << bit));
      read_hostile(reader, bytes);
    }
    for (const char value : {'\0', '\xFF', '\n', '\r', ' ', '-', '9', '#', '\\', 'e', '/'}) {
      byte = value;
      read_hostile(reader, bytes);
    }
    byte = kept;
  }
}

// Reads random bytes, and random words of the format, after a beginning that the format has.
inline void check_random(FormatReader reader, const std::string& beginning,
                         const std::vector<std::string>& words) {
  const uint32_t seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = beginning;
    const uint32_t length = random() % 200;
    for (uint32_t i = 0; i < length; ++i) {
      if (round % 2 == 0) {
        bytes += static_cast<char>(random());
      } else {
        bytes += words[random() % words.size()] + (random() % 4 == 0 ? "\n" : " ");
      }
    }
    read_hostile(reader, bytes);
  }
}

// The bytes of a real scene in the folder that SOBB_SCENES names; empty where there is none.
inline std::string real_scene(const std::string& file) {
  const char* folder = std::getenv("SOBB_SCENES");
  if (folder == nullptr) return {};
  std::ifstream stream(std::filesystem::path(folder) / file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace sobb::reader_testing
