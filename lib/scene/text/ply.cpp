// SPDX-License-Identifier: Apache-2.0
// See ply.h.
#include "scene/text/ply.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "scene/text/ply_header.h"
#include "scene/text/ply_items.h"

namespace sobb {
namespace {

// An element whose items are lists of corners: faces or triangle strips. Properties are indices
// into their element's list.
struct CornerLists {
  const PlyElement* element = nullptr;
  size_t corners = 0;
};

// Which of a file's elements make the scene.
struct PlyLayout {
  const PlyElement* vertices = nullptr;
  size_t xyz[3] = {};
  CornerLists faces;
  CornerLists strips;
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

CornerLists find_corner_lists(const PlyHeader& header, std::string_view name,
                              const TextReader& text) {
  CornerLists lists;
  lists.element = find_element(header, name, text);
  if (lists.element == nullptr) return lists;
  lists.corners = find_property(*lists.element, "vertex_indices", "vertex_index", text);
  const PlyProperty& corners = lists.element->properties[lists.corners];
  if (!corners.list || !is_integer(corners.type)) {
    text.fail_here(SOBB_ERROR_SCENE_SYNTAX, "property %s of %s is no list of integers",
                   corners.name.c_str(), lists.element->name.c_str());
  }
  return lists;
}

PlyLayout find_layout(const PlyHeader& header, const TextReader& text) {
  PlyLayout layout;
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
  layout.faces = find_corner_lists(header, "face", text);
  layout.strips = find_corner_lists(header, "tristrips", text);
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
    double xyz[3] = {};
    for (size_t p = 0; p < properties.size(); ++p) {
      if (p == layout.xyz[0]) {
        xyz[0] = items.coordinate(properties[p]);
      } else if (p == layout.xyz[1]) {
        xyz[1] = items.coordinate(properties[p]);
      } else if (p == layout.xyz[2]) {
        xyz[2] = items.coordinate(properties[p]);
      } else {
        skip_property(properties[p], items);
      }
    }
    items.end();
    writer.add_vertex(xyz[0], xyz[1], xyz[2], [&items] { return items.place(); });
  }
}

// Adds the triangles of a strip, every other of which has its corners in the other order.
template <class Place>
void add_strip(std::span<const uint64_t> corners, const Place& place, SceneWriter& writer) {
  if (corners.empty()) return;  // what follows the last -1
  if (corners.size() < 3) writer.add_polygon(corners, place);
  for (size_t i = 2; i < corners.size(); ++i) {
    const size_t odd = i % 2;
    const uint64_t triangle[3] = {corners[i - 2 + odd], corners[i - 1 - odd], corners[i]};
    writer.add_polygon(triangle, place);
  }
}

// Reads faces or strips. The file's vertices are the last that the writer has.
template <class Items>
void read_corner_lists(const PlyLayout& layout, const CornerLists& lists, Items& items,
                       SceneWriter& writer) {
  const bool strips = &lists == &layout.strips;
  const std::vector<PlyProperty>& properties = lists.element->properties;
  const uint64_t vertices = layout.vertices == nullptr ? 0 : layout.vertices->count;
  const uint64_t first_vertex = writer.vertex_count() - vertices;
  const auto place = [&items] { return items.place(); };
  std::vector<uint64_t> corners;
  for (uint64_t i = 0; i < lists.element->count; ++i) {
    items.begin(*lists.element, i);
    for (size_t p = 0; p < properties.size(); ++p) {
      if (p != lists.corners) {
        skip_property(properties[p], items);
        continue;
      }
      corners.clear();
      for (uint64_t left = items.length(properties[p]); left > 0; --left) {
        if (strips && items.take_strip_end(properties[p])) {
          add_strip(corners, place, writer);
          corners.clear();
        } else {
          writer.push_corner(corners, first_vertex + items.vertex_index(properties[p], vertices));
        }
      }
    }
    items.end();
    if (strips) {
      add_strip(corners, place, writer);
    } else {
      writer.add_polygon(corners, place);
    }
  }
}

template <class Items>
void read_elements(const PlyHeader& header, const PlyLayout& layout, Items items,
                   SceneWriter& writer) {
  writer.expect(layout.vertices == nullptr ? 0 : layout.vertices->count,
                layout.faces.element == nullptr ? 0 : layout.faces.element->count);
  // Faces and strips that come before their vertices are passed over at first, and read last.
  std::vector<std::pair<const CornerLists*, Items>> early;
  bool have_vertices = layout.vertices == nullptr;
  for (const PlyElement& element : header.elements) {
    const CornerLists* lists = &element == layout.faces.element    ? &layout.faces
                               : &element == layout.strips.element ? &layout.strips
                                                                   : nullptr;
    if (&element == layout.vertices) {
      read_vertices(layout, items, writer);
      have_vertices = true;
    } else if (lists != nullptr && have_vertices) {
      read_corner_lists(layout, *lists, items, writer);
    } else {
      if (lists != nullptr) early.emplace_back(lists, items);
      skip_element(element, items);
    }
  }
  items.pass_surplus(writer);
  for (auto& [lists, at] : early) read_corner_lists(layout, *lists, at, writer);
}

}  // namespace

void read_ply(std::string_view bytes, SceneWriter& writer) {
  TextReader text(bytes, writer);
  text.refuse_wide_characters();
  const PlyHeader header = read_ply_header(text, writer);
  const PlyLayout layout = find_layout(header, text);
  if (header.encoding == PlyEncoding::kAscii) {
    read_elements(header, layout, PlyTextItems(text), writer);
    return;
  }
  const std::endian order =
      header.encoding == PlyEncoding::kLittleEndian ? std::endian::little : std::endian::big;
  read_elements(header, layout, PlyBinaryItems(header.data, order, writer), writer);
}

}  // namespace sobb
