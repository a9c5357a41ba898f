// SPDX-License-Identifier: Apache-2.0
// See off.h.
#include "scene/text/off.h"

#include <cstdint>
#include <string>
#include <vector>

#include "scene/text/text_reader.h"

namespace sobb {
namespace {

// The shortest lines are "0 0 0" and "3 0 0 0", with their ends.
constexpr uint64_t kLeastVertexBytes = 6;
constexpr uint64_t kLeastFaceBytes = 8;

// How many numbers may follow a vertex's position.
struct Extras {
  int least = 0;
  int most = 0;

  void add(int more_at_least, int more_at_most) {
    least += more_at_least;
    most += more_at_most;
  }
};

[[noreturn]] void refuse_keyword(const TextReader& text, std::string_view keyword) {
  text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" where OFF should be", quote(keyword).c_str());
}

Extras read_keyword(TextReader& text) {
  const bool any = text.next_line_with_words();
  const std::string_view keyword = any ? text.word() : std::string_view();
  if (!keyword.ends_with("OFF")) refuse_keyword(text, keyword);
  std::string prefix(keyword.substr(0, keyword.size() - 3));
  // Writers do not agree on the prefixes' order.
  const auto take = [&prefix](std::string_view part) {
    const size_t at = prefix.find(part);
    if (at == std::string::npos) return false;
    prefix.erase(at, part.size());
    return true;
  };
  Extras extras;
  if (take("ST")) extras.add(2, 2);
  if (take("C")) extras.add(3, 4);  // alpha is often left out
  if (take("N")) extras.add(3, 3);
  const bool dimensions = take("4") || take("n");
  if (!prefix.empty() && prefix != "n") refuse_keyword(text, keyword);
  if (dimensions) {
    text.fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: vertices of other than three dimensions",
                   quote(keyword).c_str());
  }
  return extras;
}

// Moves to the counts, which may stand on the keyword's line.
void find_counts(TextReader& text) {
  TextReader ahead = text;
  if (ahead.word() == "BINARY") {
    text.fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "binary OFF is not supported");
  }
  if (text.at_line_end()) text.next_line_with_words();
}

void read_vertex(TextReader& text, Extras extras, SceneWriter& writer) {
  const auto [x, y, z] = text.position();
  for (int i = 0; i < extras.most && (i < extras.least || !text.at_line_end()); ++i) {
    text.number("a normal, colour or texture coordinate");
  }
  text.expect_line_end();
  writer.add_vertex(x, y, z, [&text] { return text.place(); });
}

}  // namespace

void read_off(std::string_view bytes, SceneWriter& writer) {
  TextReader text(bytes, writer.name().c_str(), &writer);
  const Extras extras = read_keyword(text);
  find_counts(text);
  const uint64_t vertices = text.count("the count of vertices", UINT32_MAX);
  const uint64_t faces = text.count("the count of faces", UINT32_MAX);
  text.count("the count of edges", UINT64_MAX);
  text.expect_line_end();
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
    writer.add_polygon(corners, [&text] { return text.place(); });
    while (!text.at_line_end()) text.number("a colour");
  }
  if (text.next_line_with_words()) {
    text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "text after the last of %llu faces",
                   static_cast<unsigned long long>(faces));
  }
}

}  // namespace sobb
