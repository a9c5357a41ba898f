// SPDX-License-Identifier: Apache-2.0
// See obj.h.
#include "scene/text/obj.h"

#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include "scene/text/text_reader.h"

namespace sobb {
namespace {

constexpr int kMaxVertexNumbers = 7;  // x, y, z, a weight and a colour

class ObjReader {
 public:
  ObjReader(std::string_view bytes, SceneWriter& writer)
      : text_(bytes, writer), writer_(writer), first_vertex_(writer.vertex_count()) {
    text_.refuse_wide_characters();
  }

  void read() {
    while (text_.next_line()) {
      const std::string_view statement = text_.word();
      if (is_word(statement, "v")) {
        if (vertices_ == vertices_read()) read_vertex(text_);
        ++vertices_;
      } else if (is_word(statement, "f") || is_word(statement, "fo")) {  // fo: of version 2
        read_face();
      } else if (is_word(statement, "o") || is_word(statement, "g")) {
        writer_.begin_mesh(std::string(text_.rest_of_line()));
      }
    }
  }

 private:
  uint64_t vertices_read() const { return writer_.vertex_count() - first_vertex_; }

  void read_vertex(TextReader& text) {
    const auto [x, y, z] = text.position();
    for (int i = 3; i < kMaxVertexNumbers; ++i) text.word();
    text.pass_surplus();
    writer_.add_vertex(x, y, z, [&text] { return text.place(); });
  }

  // Reads the vertices of all statements to come, for a face that stands before its own.
  void read_all_vertices() {
    if (vertices_ < vertices_read()) return;
    TextReader ahead = text_;
    while (ahead.next_line()) {
      if (is_word(ahead.word(), "v")) read_vertex(ahead);
    }
  }

  void read_face() {
    corners_.clear();
    for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
      writer_.push_corner(corners_, read_corner(word));
    }
    writer_.add_polygon(corners_, [this] { return text_.place(); });
  }

  uint64_t read_corner(std::string_view word) {
    const char* end = word.data() + word.size();
    int64_t index = 0;
    const auto [after, error] = std::from_chars(word.data(), end, index);
    bool good = error != std::errc::invalid_argument;
    // The indices of texture coordinate and normal are integers, or left out.
    const char* at = after;
    for (int part = 0; part < 2 && good && at != end && *at == '/'; ++part) {
      int64_t ignored = 0;
      const auto result = std::from_chars(++at, end, ignored);
      good = result.ec != std::errc::result_out_of_range;
      at = result.ptr;
    }
    if (!good || at != end) {
      text_.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" is no corner of a face",
                      quote(word).c_str());
    }
    const auto before = static_cast<int64_t>(vertices_);
    if (index > before) read_all_vertices();
    const auto last = static_cast<int64_t>(vertices_read());
    if (error != std::errc() || index == 0 || index > last || index < -before) {
      text_.fail_here(
          SOBB_ERROR_INDEX, "corner \"%s\" names no vertex: there are %lld, %lld of them so far",
          quote(word).c_str(), static_cast<long long>(last), static_cast<long long>(before));
    }
    return first_vertex_ + static_cast<uint64_t>(index > 0 ? index - 1 : before + index);
  }

  TextReader text_;
  SceneWriter& writer_;
  uint64_t first_vertex_;
  uint64_t vertices_ = 0;  // in the statements so far; more may have been read
  std::vector<uint64_t> corners_;
};

}  // namespace

void read_obj(std::string_view bytes, SceneWriter& writer) { ObjReader(bytes, writer).read(); }

}  // namespace sobb
