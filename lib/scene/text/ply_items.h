// SPDX-License-Identifier: Apache-2.0
// Reads the items of a PLY file's elements value by value: one class reads text, the other bytes,
// with the same functions. Both are cursors that may be copied, to read a part twice.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "scene/input/number.h"
#include "scene/input/read_progress.h"
#include "scene/text/ply_header.h"
#include "scene/text/text_reader.h"

namespace sobb {

// ASCII: one item per line.
class PlyTextItems {
 public:
  // `text` stands on the last line of the header.
  explicit PlyTextItems(const TextReader& text) : text_(text) {}

  // Every item is read between these two calls, property by property.
  void begin(const PlyElement& element, uint64_t index) {
    text_.next_item(element.name, index, element.count);
  }
  void end() { text_.pass_surplus(); }

  double coordinate(const PlyProperty& property) { return text_.coordinate(property.name.c_str()); }
  uint64_t length(const PlyProperty&) { return text_.count("a list's length", UINT32_MAX); }
  uint64_t vertex_index(const PlyProperty&, uint64_t vertices) {
    return text_.vertex_index(vertices);
  }
  // Takes the -1 that ends a triangle strip; false where it is not next.
  bool take_strip_end(const PlyProperty&) { return text_.take_word("-1"); }
  void skip(const PlyProperty& property, uint64_t values) {
    text_.skip(values, property.name.c_str());
  }

  std::string place() const { return text_.place(); }
  void pass_surplus(SceneWriter&) { text_.pass_surplus_lines(); }

 private:
  TextReader text_;
};

// Binary: values packed without gaps.
class PlyBinaryItems {
 public:
  PlyBinaryItems(std::string_view bytes, std::endian order, SceneWriter& writer)
      : at_(bytes.data()),
        end_(bytes.data() + bytes.size()),
        progress_(bytes, &writer),
        order_(order),
        name_(writer.name().c_str()) {}

  void begin(const PlyElement& element, uint64_t index) {
    element_ = &element;
    index_ = index;
  }
  void end() {}

  double coordinate(const PlyProperty& property) { return within_float(value(property.type)); }
  uint64_t length(const PlyProperty& property);
  uint64_t vertex_index(const PlyProperty& property, uint64_t vertices);
  bool take_strip_end(const PlyProperty& property);
  void skip(const PlyProperty& property, uint64_t values) { take(values * size_of(property.type)); }

  std::string place() const;
  void pass_surplus(SceneWriter& writer) const;

 private:
  // The next `bytes` bytes; SCENE_SYNTAX where the file ends before.
  const char* take(uint64_t bytes);
  double value(PlyType type);  // exact for every type

  const char* at_;
  const char* end_;
  ReadProgress progress_;
  std::endian order_;
  const char* name_;
  const PlyElement* element_ = nullptr;
  uint64_t index_ = 0;
};

}  // namespace sobb
