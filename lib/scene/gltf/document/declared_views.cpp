// SPDX-License-Identifier: Apache-2.0
// See declared_views.h.
#include "scene/gltf/document/declared_views.h"

#include <utility>

namespace sobb {
namespace {

using nlohmann::json;
using Kind = JsonKind;

constexpr const char* kMeshoptExtensions[] = {"KHR_meshopt_compression", "EXT_meshopt_compression"};

void require(const CheckedJson& source, const json& members, JsonMembers wanted,
             const std::string& place) {
  for (const JsonMember& member : wanted) {
    if (!members.contains(member.name)) source.refuse(place + "." + member.name, "is missing");
  }
}

// A member of what members() returned, which has checked its type.
uint64_t size_of(const json& members, const char* key) { return members.value(key, uint64_t{0}); }

GltfBuffer buffer_of(const CheckedJson& source, const json& given, const std::string& place) {
  constexpr JsonMember kLength = {"byteLength", Kind::kSize};
  json copied = source.members(given, {kLength, {"uri", Kind::kText}}, place);
  require(source, copied, {kLength}, place);
  GltfBuffer buffer;
  buffer.byte_length = size_of(copied, "byteLength");
  if (copied.contains("uri")) buffer.uri = std::move(copied["uri"].get_ref<std::string&>());
  return buffer;
}

GltfMeshopt meshopt_of(const CheckedJson& source, const json& given, const std::string& place) {
  const JsonMembers needed = {{"buffer", Kind::kIndex},
                              {"byteLength", Kind::kSize},
                              {"byteStride", Kind::kSize},
                              {"count", Kind::kSize},
                              {"mode", Kind::kText}};
  json copied = source.members(given, needed, place);
  require(source, copied, needed, place);
  copied.update(
      source.members(given, {{"byteOffset", Kind::kSize}, {"filter", Kind::kText}}, place));
  GltfMeshopt result;
  result.buffer = int(size_of(copied, "buffer"));
  result.byte_offset = size_of(copied, "byteOffset");
  result.byte_length = size_of(copied, "byteLength");
  result.byte_stride = size_of(copied, "byteStride");
  result.count = size_of(copied, "count");
  result.mode = copied["mode"].get<std::string>();
  result.filter = copied.value("filter", std::string("NONE"));
  return result;
}

GltfView view_of(const CheckedJson& source, const json& given, const std::string& place) {
  const JsonMembers needed = {{"buffer", Kind::kIndex}, {"byteLength", Kind::kSize}};
  json copied = source.members(given, needed, place);
  require(source, copied, needed, place);
  copied.update(
      source.members(given, {{"byteOffset", Kind::kSize}, {"byteStride", Kind::kSize}}, place));
  GltfView view;
  view.buffer = int(size_of(copied, "buffer"));
  view.byte_offset = size_of(copied, "byteOffset");
  view.byte_length = size_of(copied, "byteLength");
  view.byte_stride = size_of(copied, "byteStride");
  for (const char* extension : kMeshoptExtensions) {
    const json* const found = extension_of(given, extension);
    if (found == nullptr) continue;
    view.compressed = meshopt_of(source, *found, place + "." + extension);
    view.compressed->extension = extension;
  }
  return view;
}

template <class Element>
std::vector<Element> declared(const CheckedJson& source, const char* key, GltfItem kind,
                              GltfFaults& faults,
                              Element (*read)(const CheckedJson&, const json&,
                                              const std::string&)) {
  std::vector<Element> result;
  source.for_each(source.document(), key, "", [&](const json& given, const std::string& place) {
    Element& element = result.emplace_back();
    const std::string fault = source.fault_of([&] { element = read(source, given, place); });
    if (!fault.empty()) faults.add(kind, result.size() - 1, fault);
  });
  return result;
}

}  // namespace

std::vector<GltfBuffer> declared_buffers(const CheckedJson& source, GltfFaults& faults) {
  return declared(source, "buffers", GltfItem::kBuffer, faults, buffer_of);
}

std::vector<GltfView> declared_views(const CheckedJson& source, GltfFaults& faults) {
  return declared(source, "bufferViews", GltfItem::kView, faults, view_of);
}

}  // namespace sobb
