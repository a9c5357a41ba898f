// SPDX-License-Identifier: Apache-2.0
// See ply.h.
#include "scene/text/ply.h"

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/text/ply_header.h"
#include "scene/text/ply_items.h"

namespace sobb {
namespace {

// Which of a file's elements are the vertices and faces. Properties are indices into their
// element's list.
struct PlyLayout {
  const PlyElement* vertices = nullptr;
  size_t xyz[3] = {};
  const PlyElement* faces = nullptr;
  size_t corners = 0;
};

// The element of that name, or null; `text` is for messages.
const PlyElement* find_element(const PlyHeader& header, std::string_view name,
                               const TextReader& text) {
  const PlyElement* found = nullptr;
  for (const PlyElement& element : header.elements) {
    if (element.name != name) continue;
    if (found != nullptr) {
      text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "the header has element %s twice",
                     element.name.c_str());
    }
    found = &element;
  }
  return found;
}

// The index of the element's one property of either name.
size_t find_property(const PlyElement& element, std::string_view name, std::string_view other_name,
                     const TextReader& text) {
  size_t found = 0;
  int count = 0;
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const std::string& own = element.properties[i].name;
    if (own != name && own != other_name) continue;
    found = i;
    ++count;
  }
  if (count != 1) {
    text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "element %s has property %s %s", element.name.c_str(),
                   std::string(name).c_str(), count == 0 ? "not at all" : "more than once");
  }
  return found;
}

PlyLayout find_layout(const PlyHeader& header, const TextReader& text) {
  PlyLayout layout;
  const PlyElement* strips = find_element(header, "tristrips", text);
  if (strips != nullptr && strips->count > 0) {
    text.fail_here(SOBB_ERROR_SCENE_UNSUPPORTED, "tristrips (triangle strips) are not supported");
  }
  layout.vertices = find_element(header, "vertex", text);
  if (layout.vertices != nullptr) {
    const char* const axes[3] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
      layout.xyz[k] = find_property(*layout.vertices, axes[k], axes[k], text);
      if (layout.vertices->properties[layout.xyz[k]].list) {
        text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "property %s of vertex is a list", axes[k]);
      }
    }
  }
  layout.faces = find_element(header, "face", text);
  if (layout.faces != nullptr) {
    layout.corners = find_property(*layout.faces, "vertex_indices", "vertex_index", text);
    const PlyProperty& corners = layout.faces->properties[layout.corners];
    if (!corners.list || !is_integer(corners.type)) {
      text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "property %s of face is no list of integers",
                     corners.name.c_str());
    }
  }
  return layout;
}

template <class Items>
void skip_property(const PlyProperty& property, Items& items) {
  items.skip(property, property.list ? items.length(property) : 1);
}

template <class Items>
void skip_element(const PlyElement& element, Items& items) {
  if (element.properties.empty()) return;  // the items take no bytes
  for (uint64_t i = 0; i < element.count; ++i) {
    items.begin(element, i);
    for (const PlyProperty& property : element.properties) skip_property(property, items);
    items.end();
  }
}

template <class Items>
void read_vertices(const PlyLayout& layout, Items& items, SceneWriter& writer) {
  const std::vector<PlyProperty>& properties = layout.vertices->properties;
  for (uint64_t i = 0; i < layout.vertices->count; ++i) {
    items.begin(*layout.vertices, i);
    float xyz[3] = {};
    for (size_t p = 0; p < properties.size(); ++p) {
      if (p == layout.xyz[0]) {
        xyz[0] = items.number(properties[p]);
      } else if (p == layout.xyz[1]) {
        xyz[1] = items.number(properties[p]);
      } else if (p == layout.xyz[2]) {
        xyz[2] = items.number(properties[p]);
      } else {
        skip_property(properties[p], items);
      }
    }
    items.end();
    writer.add_vertex(xyz[0], xyz[1], xyz[2], [&items] { return items.place(); });
  }
}

// The file's vertices are the last that the writer has.
template <class Items>
void read_faces(const PlyLayout& layout, Items& items, SceneWriter& writer) {
  const std::vector<PlyProperty>& properties = layout.faces->properties;
  const uint64_t vertices = layout.vertices == nullptr ? 0 : layout.vertices->count;
  const uint64_t first_vertex = writer.vertex_count() - vertices;
  std::vector<uint64_t> corners;
  for (uint64_t i = 0; i < layout.faces->count; ++i) {
    items.begin(*layout.faces, i);
    for (size_t p = 0; p < properties.size(); ++p) {
      if (p != layout.corners) {
        skip_property(properties[p], items);
        continue;
      }
      corners.clear();
      for (uint64_t left = items.length(properties[p]); left > 0; --left) {
        writer.push_corner(corners, first_vertex + items.vertex_index(properties[p], vertices));
      }
    }
    items.end();
    writer.add_polygon(corners, [&items] { return items.place(); });
  }
}

template <class Items>
void read_elements(const PlyHeader& header, const PlyLayout& layout, Items items,
                   SceneWriter& writer) {
  writer.expect(layout.vertices == nullptr ? 0 : layout.vertices->count,
                layout.faces == nullptr ? 0 : layout.faces->count);
  // Faces that come before their vertices are passed over at first, and read last.
  std::optional<Items> early_faces;
  bool have_vertices = layout.vertices == nullptr;
  for (const PlyElement& element : header.elements) {
    if (&element == layout.vertices) {
      read_vertices(layout, items, writer);
      have_vertices = true;
    } else if (&element == layout.faces && have_vertices) {
      read_faces(layout, items, writer);
    } else {
      if (&element == layout.faces) early_faces = items;
      skip_element(element, items);
    }
  }
  items.expect_end_of_file();
  if (early_faces) read_faces(layout, *early_faces, writer);
}

}  // namespace

void read_ply(std::string_view bytes, SceneWriter& writer) {
  TextReader text(bytes, writer.name().c_str(), &writer);
  const PlyHeader header = read_ply_header(text);
  const PlyLayout layout = find_layout(header, text);
  if (header.encoding == PlyEncoding::kAscii) {
    read_elements(header, layout, PlyTextItems(text), writer);
    return;
  }
  const std::endian order =
      header.encoding == PlyEncoding::kLittleEndian ? std::endian::little : std::endian::big;
  read_elements(header, layout, PlyBinaryItems(text.text_after_line(), order, writer), writer);
}

}  // namespace sobb
