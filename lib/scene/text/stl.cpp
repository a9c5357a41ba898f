// SPDX-License-Identifier: Apache-2.0
// See stl.h.
#include "scene/text/stl.h"

#include <cstdint>
#include <string>
#include <vector>

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

constexpr std::string_view kSolid = "solid";

uint64_t declared_triangles(std::string_view bytes) {
  return load_little<uint32_t>(bytes.data() + kCountAt);
}

uint64_t binary_size(uint64_t triangles) { return kHeaderBytes + triangles * kTriangleBytes; }

// Binary files may begin with the word solid as well, but text has no zero byte.
bool begins_as_ascii(std::string_view bytes, SceneWriter& writer) {
  TextReader text(bytes, writer);
  const std::string_view word = text.word_of_any_line();
  return (is_word(word.substr(0, kSolid.size()), kSolid) || is_word(word, "facet")) &&
         bytes.substr(0, kHeaderBytes).find('\0') == std::string_view::npos;
}

// The triangle's corners are the last three vertices.
template <class Place>
void add_triangle(SceneWriter& writer, const Place& place) {
  const uint64_t first = writer.vertex_count() - 3;
  const uint64_t corners[3] = {first, first + 1, first + 2};
  writer.add_polygon(corners, place);
}

void read_binary(std::string_view bytes, uint64_t triangles, SceneWriter& writer) {
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
  const uint64_t surplus = bytes.size() - binary_size(triangles);
  if (surplus == 0) return;
  writer.note(
      SOBB_NOTE_SURPLUS,
      [&] {
        return std::to_string(surplus) + " bytes after triangle " + std::to_string(triangles);
      },
      surplus);
}

// Reads ASCII word by word: writers agree neither on the lines nor on how statements end.
class AsciiReader {
 public:
  AsciiReader(std::string_view bytes, SceneWriter& writer)
      : text_(bytes, writer), writer_(writer) {}

  void read() {
    for (std::string_view word = text_.word_of_any_line(); !word.empty();
         word = text_.word_of_any_line()) {
      read_statement(word);
    }
    if (in_loop_ && corners_.size() < 3) {
      text_.fail_here(SOBB_ERROR_SCENE_SYNTAX, "the file ends within a facet");
    }
    end_loop();
  }

 private:
  void read_statement(std::string_view word) {
    if (is_word(word, "vertex") && in_loop_) {
      read_vertex();
    } else if (is_word(word, "facet")) {
      begin_loop();
      skip_normal();
    } else if (is_word(word, "outer") || is_word(word, "outerloop")) {
      begin_loop();
      text_.take_word("loop");
    } else if (is_word(word.substr(0, kSolid.size()), kSolid)) {
      end_loop();
      std::string name(word.substr(kSolid.size()));
      writer_.begin_mesh(name.append(text_.rest_of_line()));
    } else if (is_word(word, "end")) {
      read_end(text_.word());
    } else if (is_word(word.substr(0, 3), "end")) {
      read_end(word.substr(3));
    } else {
      refuse(word);
    }
  }

  // The word after end, which may be glued to it, and a solid's name to that.
  void read_end(std::string_view what) {
    if (is_word(what.substr(0, kSolid.size()), kSolid)) {
      text_.rest_of_line();
    } else if (!is_word(what, "loop") && !is_word(what, "facet")) {
      refuse(what);
    }
    end_loop();
  }

  // A facet begins its loop, which the loop's own line begins once more.
  void begin_loop() {
    if (!corners_.empty()) end_loop();
    in_loop_ = true;
  }

  // Ends may be missing, and are told from what follows.
  void end_loop() {
    if (in_loop_) writer_.add_polygon(corners_, [this] { return text_.place(); });
    in_loop_ = false;
    corners_.clear();
  }

  // Some writers leave the normal undefined, in any spelling.
  void skip_normal() {
    for (TextReader ahead = text_; !ahead.at_line_end(); text_ = ahead) {
      const std::string_view word = ahead.word();
      if (is_word(word, "outer") || is_word(word, "vertex")) return;
    }
  }

  void read_vertex() {
    const auto [x, y, z] = text_.position();
    writer_.push_corner(corners_, writer_.vertex_count());
    writer_.add_vertex(x, y, z, [this] { return text_.place(); });
    text_.pass_surplus_numbers();
  }

  [[noreturn]] void refuse(std::string_view word) const {
    text_.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" where a statement of STL should be",
                    quote(word).c_str());
  }

  TextReader text_;
  SceneWriter& writer_;
  bool in_loop_ = false;
  std::vector<uint64_t> corners_;
};

// The triangles of a binary file. Some writers leave the count at zero.
uint64_t binary_triangles(std::string_view bytes) {
  const uint64_t declared = declared_triangles(bytes);
  const uint64_t fitting = (bytes.size() - kHeaderBytes) / kTriangleBytes;
  return declared == 0 && bytes.size() == binary_size(fitting) ? fitting : declared;
}

}  // namespace

void read_stl(std::string_view bytes, SceneWriter& writer) {
  const char* name = writer.name().c_str();
  const bool has_count = bytes.size() >= kHeaderBytes;
  if (has_count && bytes.size() == binary_size(binary_triangles(bytes))) {
    read_binary(bytes, binary_triangles(bytes), writer);
    return;
  }
  if (begins_as_ascii(bytes, writer)) {
    AsciiReader(bytes, writer).read();
    return;
  }
  TextReader(bytes, writer).refuse_wide_characters();
  if (!has_count) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %zu bytes are no STL: ASCII begins with solid", name,
         bytes.size());
  }
  const uint64_t triangles = declared_triangles(bytes);
  if (bytes.size() < binary_size(triangles)) {
    fail(SOBB_ERROR_SCENE_SYNTAX,
         "%s: binary STL of %llu triangles takes %llu bytes, the file has %zu", name,
         static_cast<unsigned long long>(triangles),
         static_cast<unsigned long long>(binary_size(triangles)), bytes.size());
  }
  read_binary(bytes, triangles, writer);
}

}  // namespace sobb
