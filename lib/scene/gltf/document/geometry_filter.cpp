// SPDX-License-Identifier: Apache-2.0
// See geometry_filter.h.
#include "scene/gltf/document/geometry_filter.h"

#include <utility>

namespace sobb {
namespace {

using nlohmann::json;
using Kind = JsonKind;

// A function copies an element that is at `place` of the document.
using Copy = json (*)(const CheckedJson& source, const json& given, const std::string& place);

json copy_scene(const CheckedJson& source, const json& given, const std::string& place) {
  return source.members(given, {{"nodes", Kind::kIndices}}, place);
}

json copy_node(const CheckedJson& source, const json& given, const std::string& place) {
  return source.members(given,
                        {{"name", Kind::kText},
                         {"mesh", Kind::kIndex},
                         {"camera", Kind::kIndex},
                         {"children", Kind::kIndices},
                         {"matrix", Kind::kNumbers, 16},
                         {"translation", Kind::kNumbers, 3},
                         {"rotation", Kind::kNumbers, 4},
                         {"scale", Kind::kNumbers, 3}},
                        place);
}

json copy_primitive(const CheckedJson& source, const json& given, const std::string& place) {
  json result = source.members(given, {{"mode", Kind::kIndex}, {"indices", Kind::kIndex}}, place);
  const json& attributes = source.object(given, "attributes", place);
  result["attributes"] = source.members(attributes, {{"POSITION", Kind::kIndex}}, place);
  return result;
}

json copy_mesh(const CheckedJson& source, const json& given, const std::string& place) {
  json result = source.members(given, {{"name", Kind::kText}}, place);
  source.for_each(given, "primitives", place + ".",
                  [&](const json& primitive, const std::string& here) {
                    result["primitives"].push_back(copy_primitive(source, primitive, here));
                  });
  return result;
}

json copy_accessor(const CheckedJson& source, const json& given, const std::string& place) {
  json result = source.members(given,
                               {{"bufferView", Kind::kIndex},
                                {"byteOffset", Kind::kSize},
                                {"componentType", Kind::kIndex},
                                {"normalized", Kind::kBool},
                                {"count", Kind::kSize},
                                {"type", Kind::kText}},
                               place);
  if (!given.contains("sparse")) return result;
  const json& sparse = source.object(given, "sparse", place);
  json& copied = result["sparse"];
  copied = source.members(sparse, {{"count", Kind::kIndex}}, place + ".sparse");
  for (const char* part : {"indices", "values"}) {
    copied[part] = source.members(source.object(sparse, part, place + ".sparse"),
                                  {{"bufferView", Kind::kIndex},
                                   {"byteOffset", Kind::kIndex},
                                   {"componentType", Kind::kIndex}},
                                  place + ".sparse." + part);
  }
  return result;
}

json copy_buffer_view(const CheckedJson& source, const json& given, const std::string& place) {
  return source.members(given,
                        {{"buffer", Kind::kIndex},
                         {"byteOffset", Kind::kSize},
                         {"byteLength", Kind::kSize},
                         {"byteStride", Kind::kSize}},
                        place);
}

json copy_camera(const CheckedJson& source, const json& given, const std::string& place) {
  json result = source.members(given, {{"type", Kind::kText}}, place);
  const auto copy_lens = [&](const char* lens, JsonMembers wanted) {
    if (!given.contains(lens)) return;
    result[lens] = source.members(source.object(given, lens, place), wanted, place + "." + lens);
  };
  copy_lens("perspective", {{"yfov", Kind::kNumber}, {"znear", Kind::kNumber}});
  copy_lens("orthographic", {{"xmag", Kind::kNumber},
                             {"ymag", Kind::kNumber},
                             {"zfar", Kind::kNumber},
                             {"znear", Kind::kNumber}});
  return result;
}

}  // namespace

json geometry_of(const CheckedJson& source) {
  const json& document = source.document();
  json result = source.members(document, {{"scene", Kind::kIndex}}, "the document");
  const json& asset = source.object(document, "asset", "the document");
  result["asset"] = source.members(asset, {{"version", Kind::kText}}, "asset");
  const auto copy_all = [&](const char* key, Copy copy) {
    source.for_each(document, key, "", [&](const json& element, const std::string& place) {
      result[key].push_back(copy(source, element, place));
    });
  };
  copy_all("scenes", copy_scene);
  copy_all("nodes", copy_node);
  copy_all("meshes", copy_mesh);
  copy_all("accessors", copy_accessor);
  copy_all("bufferViews", copy_buffer_view);
  copy_all("cameras", copy_camera);
  return result;
}

std::vector<GltfBuffer> declared_buffers(const CheckedJson& source) {
  std::vector<GltfBuffer> result;
  source.for_each(
      source.document(), "buffers", "", [&](const json& given, const std::string& place) {
        json copied =
            source.members(given, {{"byteLength", Kind::kSize}, {"uri", Kind::kText}}, place);
        if (!copied.contains("byteLength")) source.refuse(place + ".byteLength", "is missing");
        GltfBuffer& buffer = result.emplace_back();
        buffer.byte_length = copied["byteLength"].get<uint64_t>();
        if (copied.contains("uri")) buffer.uri = std::move(copied["uri"].get_ref<std::string&>());
      });
  return result;
}

}  // namespace sobb
