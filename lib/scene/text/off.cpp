// SPDX-License-Identifier: Apache-2.0
// See off.h.
#include "scene/text/off.h"

#include <cstdint>
#include <string>
#include <vector>

#include "scene/input/ascii.h"
#include "scene/text/text_reader.h"

namespace sobb {
namespace {

// The shortest lines are "0 0 0" and "0", with their ends.
constexpr uint64_t kLeastVertexBytes = 6;
constexpr uint64_t kLeastFaceBytes = 2;

[[noreturn]] void refuse_keyword(const TextReader& text, std::string_view keyword) {
  text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" where OFF should be", quote(keyword).c_str());
}

// How many numbers may follow a vertex's position, by what stands before OFF.
int extras_of(const TextReader& text, std::string_view keyword) {
  std::string prefix(keyword.substr(0, keyword.size() - 3));
  // Writers do not agree on the prefixes' order.
  const auto take = [&prefix](std::string_view part) {
    const size_t at = prefix.find(part);
    if (at == std::string::npos) return false;
    prefix.erase(at, part.size());
    return true;
  };
  // Only beside OFF itself in capitals does n mean another thing than N.
  if (!keyword.ends_with("OFF")) {
    for (char& c : prefix) c = ascii_upper(c);
  }
  const int extras = (take("ST") ? 2 : 0) + (take("C") ? 4 : 0) + (take("N") ? 3 : 0);
  const bool dimensions = take("4") || take("n");
  if (!prefix.empty() && prefix != "n") refuse_keyword(text, keyword);
  if (dimensions) {
    text.fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: vertices of other than three dimensions",
                   quote(keyword).c_str());
  }
  return extras;
}

// Reads the keyword and returns how many numbers may follow a vertex's position. The keyword may be
// missing, and the count of vertices may be glued to it.
int read_keyword(TextReader& text) {
  if (!text.next_line_with_words()) refuse_keyword(text, "");
  TextReader ahead = text;
  const std::string_view word = ahead.word();
  size_t end = 3;
  while (end <= word.size() && !is_word(word.substr(end - 3, 3), "off")) ++end;
  if (end > word.size()) {
    if (word[0] < '0' || word[0] > '9') refuse_keyword(text, word);
    return 0;
  }
  text.pass(end);
  const int extras = extras_of(text, word.substr(0, end));
  if (text.take_word("binary")) {
    text.fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "binary OFF is not supported");
  }
  return extras;
}

struct OffCounts {
  uint64_t vertices = 0;
  uint64_t faces = 0;
};

// Each count may have a line of its own, and that of edges, which nobody needs, may be missing.
OffCounts read_counts(TextReader& text) {
  OffCounts counts;
  if (text.at_line_end()) text.next_line_with_words();
  counts.vertices = text.count("the count of vertices", UINT32_MAX);
  const bool own_lines = text.at_line_end() && text.next_line_with_words();
  counts.faces = text.count("the count of faces", UINT32_MAX);
  if (text.at_line_end()) {
    TextReader ahead = text;
    const bool alone =
        own_lines && ahead.next_line_with_words() && !ahead.word().empty() && ahead.at_line_end();
    if (!alone) return counts;
    text.next_line_with_words();
  }
  text.count("the count of edges", UINT64_MAX);
  text.pass_surplus();
  return counts;
}

void read_vertex(TextReader& text, int extras, SceneWriter& writer) {
  const auto [x, y, z] = text.position();
  for (int i = 0; i < extras; ++i) text.word();
  text.pass_surplus();
  writer.add_vertex(x, y, z, [&text] { return text.place(); });
}

}  // namespace

void read_off(std::string_view bytes, SceneWriter& writer) {
  TextReader text(bytes, writer);
  text.refuse_wide_characters();
  const int extras = read_keyword(text);
  const auto [vertices, faces] = read_counts(text);
  // The last line may lack its end.
  if (vertices * kLeastVertexBytes + faces * kLeastFaceBytes > text.bytes_left() + 1) {
    text.fail_here(SOBB_ERROR_SCENE_SYNTAX,
                   "%llu vertices and %llu faces do not fit in the %llu bytes that follow",
                   static_cast<unsigned long long>(vertices),
                   static_cast<unsigned long long>(faces),
                   static_cast<unsigned long long>(text.bytes_left()));
  }
  writer.expect(vertices, faces);

  const uint64_t first_vertex = writer.vertex_count();
  for (uint64_t i = 0; i < vertices; ++i) {
    text.next_item("vertex", i, vertices);
    read_vertex(text, extras, writer);
  }
  std::vector<uint64_t> corners;
  for (uint64_t i = 0; i < faces; ++i) {
    text.next_item("face", i, faces);
    corners.clear();
    for (uint64_t left = text.count("the count of corners", UINT32_MAX); left > 0; --left) {
      writer.push_corner(corners, first_vertex + text.vertex_index(vertices));
    }
    // A colour may follow.
    writer.add_polygon(corners, [&text] { return text.place(); });
  }
  text.pass_surplus_lines();
}

}  // namespace sobb
