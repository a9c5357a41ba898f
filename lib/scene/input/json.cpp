// SPDX-License-Identifier: Apache-2.0
// See json.h.
#include "scene/input/json.h"

#include <algorithm>

#include "base/error.h"

namespace sobb {
namespace {

constexpr uint64_t kMaxDepth = 128;
constexpr uint64_t kMostWithoutLimit = uint64_t{4} << 30;

// What nlohmann::json takes, allocations rounded up.
constexpr uint64_t kElementBytes = 3 * sizeof(nlohmann::json);  // the array doubles, by a copy
constexpr uint64_t kMemberBytes = 112;                          // in a std::map
// What each is allocated for beyond its elements.
constexpr uint64_t kObjectBytes = 64;
constexpr uint64_t kArrayBytes = 48;
constexpr uint64_t kStringBytes = 64;
// The parser keeps a token twice, in arrays that double, and an error's message keeps it again.
constexpr uint64_t kCopiesOfToken = 6;

}  // namespace

void refuse_json(const std::string& name, const std::string& place, const char* what) {
  fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s %s", name.c_str(), place.c_str(), what);
}

uint64_t JsonSize::tree_bytes() const {
  return kElementBytes * (1 + commas + arrays) + kMemberBytes * colons + kObjectBytes * objects +
         kArrayBytes * arrays + kStringBytes * strings + 2 * string_bytes;
}

uint64_t JsonSize::parse_bytes() const { return tree_bytes() + kCopiesOfToken * longest_token; }

JsonSize measure_json(std::string_view text) {
  JsonSize size;
  uint64_t depth = 0;
  uint64_t token = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    ++token;
    size.longest_token = std::max(size.longest_token, token);
    ++(quoted ? size.string_bytes : size.other_bytes);
    if (c == '"') {
      size.strings += quoted ? 0 : 1;
      quoted = !quoted;
      token = 0;
    } else if (quoted) {
      if (c == '\\') ++i;
    } else if (c == ',' || c == ':') {
      ++(c == ',' ? size.commas : size.colons);
      token = 0;
    } else if (c == '{' || c == '[') {
      ++(c == '{' ? size.objects : size.arrays);
      size.depth = std::max(size.depth, ++depth);
      token = 0;
    } else if (c == '}' || c == ']') {
      depth -= depth > 0 ? 1 : 0;
      token = 0;
    }
  }
  return size;
}

void check_json_room(uint64_t bytes, const std::string& name, const SceneWriter& writer) {
  if (!writer.has_limit() && bytes > kMostWithoutLimit) {
    fail(SOBB_ERROR_MEMORY_LIMIT,
         "%s: its JSON may take %llu bytes, more than the 4 GiB that it has without a memory limit",
         name.c_str(), static_cast<unsigned long long>(bytes));
  }
  writer.check_room(bytes);
}

nlohmann::json parse_json(std::string_view text, const std::string& name, SceneWriter& writer) {
  const JsonSize size = measure_json(text);
  if (size.depth > kMaxDepth) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: JSON nested deeper than %d levels", name.c_str(),
         static_cast<int>(kMaxDepth));
  }
  check_json_room(size.parse_bytes(), name, writer);
  const auto report = [&](int, nlohmann::json::parse_event_t, nlohmann::json&) {
    writer.work(1);
    return true;
  };
  try {
    return nlohmann::json::parse(text.begin(), text.end(), report);
  } catch (const nlohmann::json::exception& error) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s", name.c_str(), error.what());
  }
}

}  // namespace sobb
