// SPDX-License-Identifier: Apache-2.0
// See ply_header.h.
#include "scene/text/ply_header.h"

#include <utility>

namespace sobb {
namespace {

PlyType read_type(TextReader& text) {
  constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},   {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16}, {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat},   {"float32", PlyType::kFloat}, {"double", PlyType::kDouble},
      {"float64", PlyType::kDouble}};
  const std::string_view word = text.word();
  for (const auto& [name, type] : kTypes) {
    if (word == name) return type;
  }
  text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" is no type of a property", quote(word).c_str());
}

PlyEncoding read_encoding(TextReader& text) {
  const std::string_view word = text.word();
  PlyEncoding encoding = PlyEncoding::kAscii;
  if (word == "binary_little_endian") {
    encoding = PlyEncoding::kLittleEndian;
  } else if (word == "binary_big_endian") {
    encoding = PlyEncoding::kBigEndian;
  } else if (word != "ascii") {
    text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" is no format of PLY", quote(word).c_str());
  }
  const std::string_view version = text.word();
  if (version != "1.0") {
    text.fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "version \"%s\" of PLY", quote(version).c_str());
  }
  return encoding;
}

PlyProperty read_property(TextReader& text) {
  PlyProperty property;
  property.list = text.take_word("list");
  if (property.list) {
    property.count_type = read_type(text);
    if (!is_integer(property.count_type)) {
      text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "a list's length must be an integer");
    }
  }
  property.type = read_type(text);
  property.name = text.required_word("a property's name");
  return property;
}

bool is_keyword(std::string_view word) {
  return word == "format" || word == "element" || word == "property" || word == "end_header";
}

// The fewest bytes of an item. In ASCII every value has a character, and a blank or a line's end.
uint64_t least_bytes(const PlyElement& element, PlyEncoding encoding) {
  if (encoding == PlyEncoding::kAscii) return 2 * element.properties.size();
  uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += size_of(property.list ? property.count_type : property.type);
  }
  return bytes;
}

// Refuses elements that the rest of the file cannot hold.
void check_counts(const PlyHeader& header, const TextReader& text) {
  // The last line of text may lack its end.
  uint64_t left = header.data.size() + (header.encoding == PlyEncoding::kAscii ? 1 : 0);
  for (const PlyElement& element : header.elements) {
    const uint64_t bytes = least_bytes(element, header.encoding);
    if (bytes == 0) continue;
    if (element.count > left / bytes) {
      text.fail_here(SOBB_ERROR_SCENE_SYNTAX,
                     "%llu of element %s do not fit in the %llu bytes that are left for them",
                     static_cast<unsigned long long>(element.count), quote(element.name).c_str(),
                     static_cast<unsigned long long>(left));
    }
    left -= element.count * bytes;
  }
}

}  // namespace

uint64_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kDouble:
      break;
  }
  return 8;
}

PlyHeader read_ply_header(TextReader& text, SceneWriter& writer) {
  PlyHeader header;
  if (!text.next_line() || !is_word(text.rest_of_line(), "ply")) {
    text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "the first line is not \"ply\"");
  }
  // Where lines end with CR, an LF after the last one is the first byte of the data.
  const bool cr_alone = text.ends_with_cr();
  bool has_format = false;
  while (text.next_line_with_words()) {
    const std::string_view keyword = text.word();
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format" && !has_format) {
      header.encoding = read_encoding(text);
      has_format = true;
    } else if (keyword == "element") {
      PlyElement& element = header.elements.emplace_back();
      element.name = text.required_word("an element's name");
      element.count = text.count("the count of an element", UINT64_MAX);
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(text));
    } else if (keyword == "end_header" && has_format) {
      text.expect_line_end();
      header.data = cr_alone ? text.text_after_cr() : text.text_after_line();
      check_counts(header, text);
      return header;
    } else if (is_keyword(keyword)) {
      text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "\"%s\" cannot stand here", quote(keyword).c_str());
    } else {
      // A comment that lacks its keyword.
      writer.note(SOBB_NOTE_UNUSED_ITEM, [&] {
        return text.place() + ": \"" + quote(keyword) + "\" is no statement of a header";
      });
      continue;
    }
    text.expect_line_end();
  }
  text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "the file ends before end_header");
}

}  // namespace sobb
