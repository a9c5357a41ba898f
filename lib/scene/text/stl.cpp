// SPDX-License-Identifier: Apache-2.0
// See stl.h.
#include "scene/text/stl.h"

#include <cstdint>
#include <string>

#include "base/error.h"
#include "scene/input/load_bytes.h"
#include "scene/text/text_reader.h"

namespace sobb {
namespace {

constexpr uint64_t kHeaderBytes = 84;  // 80 of text, then the count of triangles
constexpr uint64_t kCountAt = 80;
constexpr uint64_t kTriangleBytes = 50;  // a normal, three vertices, two bytes of attributes
constexpr uint64_t kVertexAt = 12;
constexpr uint64_t kVertexBytes = 12;

uint64_t declared_triangles(std::string_view bytes) {
  return load_little<uint32_t>(bytes.data() + kCountAt);
}

uint64_t binary_size(uint64_t triangles) { return kHeaderBytes + triangles * kTriangleBytes; }

// Binary files may begin with the word solid as well, but text has no zero byte.
bool begins_as_ascii(std::string_view bytes) {
  TextReader text(bytes, "");
  return text.next_line_with_words() && text.take_word("solid") &&
         bytes.substr(0, kHeaderBytes).find('\0') == std::string_view::npos;
}

// The triangle's corners are the last three vertices.
template <class Place>
void add_triangle(SceneWriter& writer, const Place& place) {
  const uint64_t first = writer.vertex_count() - 3;
  const uint64_t corners[3] = {first, first + 1, first + 2};
  writer.add_polygon(corners, place);
}

void read_binary(std::string_view bytes, SceneWriter& writer) {
  const uint64_t triangles = declared_triangles(bytes);
  writer.expect(3 * triangles, triangles);
  for (uint64_t i = 0; i < triangles; ++i) {
    const auto place = [i] { return "triangle " + std::to_string(i); };
    const char* vertex = bytes.data() + kHeaderBytes + i * kTriangleBytes + kVertexAt;
    for (int c = 0; c < 3; ++c, vertex += kVertexBytes) {
      float xyz[3];
      for (int k = 0; k < 3; ++k) {
        xyz[k] = load_little<float>(vertex + k * sizeof(float));
      }
      writer.add_vertex(xyz[0], xyz[1], xyz[2], place);
    }
    add_triangle(writer, place);
  }
}

void next_line(TextReader& text, const char* expected) {
  if (text.next_line_with_words()) return;
  text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "the file ends where %s should be", expected);
}

void expect_line(TextReader& text, const char* word) {
  next_line(text, word);
  text.expect_word(word);
}

// Reads on after the word facet. What follows that is the normal, which some writers leave
// undefined.
void read_facet(TextReader& text, SceneWriter& writer) {
  const auto place = [&text] { return text.place(); };
  expect_line(text, "outer");
  text.expect_word("loop");
  text.expect_line_end();
  for (int c = 0; c < 3; ++c) {
    expect_line(text, "vertex");
    const auto [x, y, z] = text.position();
    text.expect_line_end();
    writer.add_vertex(x, y, z, place);
  }
  for (const char* word : {"endloop", "endfacet"}) {
    expect_line(text, word);
    text.expect_line_end();
  }
  add_triangle(writer, place);
}

void read_ascii(std::string_view bytes, SceneWriter& writer) {
  TextReader text(bytes, writer.name().c_str(), &writer);
  while (text.next_line_with_words()) {
    text.expect_word("solid");
    writer.begin_mesh(std::string(text.rest_of_line()));
    next_line(text, "endsolid");
    while (text.take_word("facet")) {
      read_facet(text, writer);
      next_line(text, "endsolid");
    }
    text.expect_word("endsolid");
  }
}

}  // namespace

void read_stl(std::string_view bytes, SceneWriter& writer) {
  const char* name = writer.name().c_str();
  const bool has_count = bytes.size() >= kHeaderBytes;
  if (has_count && bytes.size() == binary_size(declared_triangles(bytes))) {
    read_binary(bytes, writer);
  } else if (begins_as_ascii(bytes)) {
    read_ascii(bytes, writer);
  } else if (has_count) {
    const uint64_t triangles = declared_triangles(bytes);
    fail(SOBB_ERROR_SCENE_SYNTAX,
         "%s: binary STL of %llu triangles takes %llu bytes, the file has %zu", name,
         static_cast<unsigned long long>(triangles),
         static_cast<unsigned long long>(binary_size(triangles)), bytes.size());
  } else {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %zu bytes are no STL: ASCII begins with solid", name,
         bytes.size());
  }
}

}  // namespace sobb
