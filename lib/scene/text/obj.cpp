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
      : text_(bytes, writer.name().c_str(), &writer),
        writer_(writer),
        first_vertex_(writer.vertex_count()) {}

  void read() {
    while (text_.next_line()) {
      const std::string_view statement = text_.word();
      if (statement == "v") {
        read_vertex();
      } else if (statement == "f" || statement == "fo") {  // fo: faces of version 2
        read_face();
      } else if (statement == "o" || statement == "g") {
        writer_.begin_mesh(std::string(text_.rest_of_line()));
      }
    }
  }

 private:
  void read_vertex() {
    const auto [x, y, z] = text_.position();
    for (int i = 3; i < kMaxVertexNumbers && !text_.at_line_end(); ++i) {
      text_.number("a weight or a colour");
    }
    text_.expect_line_end();
    writer_.add_vertex(x, y, z, [this] { return text_.place(); });
  }

  void read_face() {
    corners_.clear();
    for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
      writer_.push_corner(corners_, read_corner(word));
    }
    writer_.add_polygon(corners_, [this] { return text_.place(); });
  }

  uint64_t read_corner(std::string_view word) const {
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
    const auto vertices = static_cast<int64_t>(writer_.vertex_count() - first_vertex_);
    if (error != std::errc() || index == 0 || index > vertices || index < -vertices) {
      text_.fail_here(SOBB_ERROR_INDEX, "corner \"%s\" names no vertex: there are %lld so far",
                      quote(word).c_str(), static_cast<long long>(vertices));
    }
    return first_vertex_ + static_cast<uint64_t>(index > 0 ? index - 1 : vertices + index);
  }

  TextReader text_;
  SceneWriter& writer_;
  uint64_t first_vertex_;
  std::vector<uint64_t> corners_;
};

}  // namespace

void read_obj(std::string_view bytes, SceneWriter& writer) { ObjReader(bytes, writer).read(); }

}  // namespace sobb
