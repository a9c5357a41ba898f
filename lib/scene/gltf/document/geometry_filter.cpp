// SPDX-License-Identifier: Apache-2.0
// See geometry_filter.h.
#include "scene/gltf/document/geometry_filter.h"

#include <algorithm>
#include <string>
#include <utility>

namespace sobb {
namespace {

using nlohmann::json;
using Kind = JsonKind;

constexpr const char* kAccessorTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr int kFirstComponentType = TINYGLTF_COMPONENT_TYPE_BYTE;
constexpr int kLastComponentType = TINYGLTF_COMPONENT_TYPE_DOUBLE;

class GeometryFilter {
 public:
  GeometryFilter(const CheckedJson& source, GltfDocument& document, SceneWriter& writer)
      : source_(source), document_(document), writer_(writer), accessor_count_(count("accessors")) {
    document_.hidden.resize(count("nodes"));
  }

  json geometry() {
    json result = source_.members(source_.document(), {{"scene", Kind::kIndex}}, "the document");
    result["asset"]["version"] = "2.0";
    const json lens = {{"yfov", 1}, {"znear", 1}};
    copy_all(result, "scenes", GltfItem::kScene, json::object(), &GeometryFilter::copy_scene);
    copy_all(result, "nodes", GltfItem::kNode, json::object(), &GeometryFilter::copy_node);
    copy_all(result, "meshes", GltfItem::kMesh, json::object(), &GeometryFilter::copy_mesh);
    copy_all(result, "accessors", GltfItem::kAccessor,
             {{"bufferView", document_.views.size()},
              {"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT},
              {"count", 1},
              {"type", "VEC3"}},
             &GeometryFilter::copy_accessor);
    copy_cameras(result, {{"type", "perspective"}, {"perspective", lens}});
    const json view = {{"buffer", 0}, {"byteLength", 1}};
    result["bufferViews"] = json(document_.views.size() + 1, view);
    return result;
  }

 private:
  // A function copies an element that is at `place` of the document.
  using Copy = json (GeometryFilter::*)(const json& given, const std::string& place);

  size_t count(const char* array) const {
    const auto found = source_.document().find(array);
    return found != source_.document().end() && found->is_array() ? found->size() : 0;
  }

  void copy_all(json& result, const char* key, GltfItem kind, const json& placeholder, Copy copy) {
    json& copies = result[key] = json::array();
    source_.for_each(source_.document(), key, "", [&](const json& given, const std::string& place) {
      writer_.work(1);
      index_ = copies.size();
      json copied = placeholder;
      const std::string fault = source_.fault_of([&] { copied = (this->*copy)(given, place); });
      if (!fault.empty()) document_.faults.add(kind, index_, fault);
      copies.push_back(std::move(copied));
    });
  }

  // No triangle needs a camera, nor an array of them.
  void copy_cameras(json& result, const json& placeholder) {
    const std::string fault = source_.fault_of([&] {
      copy_all(result, "cameras", GltfItem::kCamera, placeholder, &GeometryFilter::copy_camera);
    });
    if (!fault.empty()) document_.faults.add_part(fault);
  }

  // A name that is no text is left out.
  void copy_name(const json& given, json& copied) const {
    const auto name = given.find("name");
    if (name != given.end() && name->is_string()) copied["name"] = *name;
  }

  json copy_scene(const json& given, const std::string& place) {
    return source_.members(given, {{"nodes", Kind::kIndices}}, place);
  }

  json copy_node(const json& given, const std::string& place) {
    json result = source_.members(given,
                                  {{"mesh", Kind::kIndex},
                                   {"children", Kind::kIndices},
                                   {"matrix", Kind::kNumbers, 16},
                                   {"translation", Kind::kNumbers, 3},
                                   {"rotation", Kind::kNumbers, 4},
                                   {"scale", Kind::kNumbers, 3},
                                   {"weights", Kind::kNumbers}},
                                  place);
    copy_name(given, result);
    const std::string fault = source_.fault_of([&] {
      result.update(source_.members(given, {{"camera", Kind::kIndex}}, place));
    });
    if (!fault.empty()) document_.faults.add_part(fault);
    const json* const visibility = extension_of(given, "KHR_node_visibility");
    if (visibility != nullptr) {
      const json visible =
          source_.members(*visibility, {{"visible", Kind::kBool}}, place + ".KHR_node_visibility");
      document_.hidden[index_] = !visible.value("visible", true);
    }
    return result;
  }

  // Error SCENE_SYNTAX where the accessor that the member `key` names does not exist.
  void check_accessor(const json& members, const char* key, const std::string& place) const {
    const auto found = members.find(key);
    if (found == members.end() || found->get<size_t>() < accessor_count_) return;
    source_.refuse(place + "." + key,
                   "names accessors[" + found->dump() + "], which does not exist");
  }

  json copy_attributes(const json& given, const std::string& place) const {
    json result = source_.members(given, {{"POSITION", Kind::kIndex}}, place);
    check_accessor(result, "POSITION", place);
    return result;
  }

  json copy_primitive(const json& given, size_t index, const std::string& place) {
    json result = source_.members(given, {{"mode", Kind::kIndex}}, place);
    json& attributes = result["attributes"] = json::object();
    const bool triangles = result.value("mode", 4) >= TINYGLTF_MODE_TRIANGLES;
    if (!triangles || !given.contains("attributes")) return result;  // nothing else is needed
    attributes = copy_attributes(given["attributes"], place + ".attributes");
    result.update(source_.members(given, {{"indices", Kind::kIndex}}, place));
    check_accessor(result, "indices", place);
    copy_targets(given, result, place);
    const json* const draco = extension_of(given, "KHR_draco_mesh_compression");
    if (draco != nullptr) {
      document_.draco[{int(index_), index}] =
          copy_draco(*draco, place + ".KHR_draco_mesh_compression");
    }
    return result;
  }

  // A malformed target names accessor -1, which is a fault only where its weight is not zero.
  void copy_targets(const json& given, json& result, const std::string& place) const {
    source_.for_each(given, "targets", place + ".",
                     [&](const json& target, const std::string& here) {
                       json copied = {{"POSITION", -1}};
                       source_.fault_of([&] { copied = copy_attributes(target, here); });
                       result["targets"].push_back(std::move(copied));
                     });
  }

  GltfDraco copy_draco(const json& given, const std::string& place) const {
    const json members = source_.members(given, {{"bufferView", Kind::kIndex}}, place);
    const json ids = source_.members(source_.object(given, "attributes", place),
                                     {{"POSITION", Kind::kIndex}}, place + ".attributes");
    if (!members.contains("bufferView")) source_.refuse(place + ".bufferView", "is missing");
    if (!ids.contains("POSITION")) source_.refuse(place + ".attributes.POSITION", "is missing");
    return {members["bufferView"].get<int>(), ids["POSITION"].get<uint32_t>()};
  }

  json copy_mesh(const json& given, const std::string& place) {
    json result = source_.members(given, {{"weights", Kind::kNumbers}}, place);
    copy_name(given, result);
    json& copies = result["primitives"] = json::array();
    source_.for_each(given, "primitives", place + ".",
                     [&](const json& primitive, const std::string& here) {
                       copies.push_back(copy_primitive(primitive, copies.size(), here));
                     });
    return result;
  }

  // Checks that the member `bufferView` names a view; without one it is the view more.
  void settle_view(json& members, bool optional, const std::string& place) const {
    const size_t views = document_.views.size();
    if (!members.contains("bufferView")) {
      if (!optional) source_.refuse(place + ".bufferView", "is missing");
      members["bufferView"] = views;
    } else if (members["bufferView"].get<size_t>() >= views) {
      source_.refuse(place, "names no bufferView, " + members["bufferView"].dump());
    }
  }

  json copy_accessor(const json& given, const std::string& place) {
    const JsonMembers needed = {
        {"componentType", Kind::kIndex}, {"count", Kind::kSize}, {"type", Kind::kText}};
    json result = source_.members(given, needed, place);
    for (const JsonMember& member : needed) {
      if (!result.contains(member.name)) source_.refuse(place + "." + member.name, "is missing");
    }
    const int component = result["componentType"].get<int>();
    if (component < kFirstComponentType || component > kLastComponentType ||
        std::ranges::find(kAccessorTypes, result["type"]) == std::end(kAccessorTypes)) {
      source_.refuse(place, "has an unknown type or componentType");
    }
    result.update(source_.members(
        given,
        {{"bufferView", Kind::kIndex}, {"byteOffset", Kind::kSize}, {"normalized", Kind::kBool}},
        place));
    settle_view(result, true, place);
    if (given.contains("sparse")) {
      result["sparse"] = copy_sparse(source_.object(given, "sparse", place), place + ".sparse");
    }
    return result;
  }

  json copy_sparse(const json& given, const std::string& place) const {
    json result = source_.members(given, {{"count", Kind::kIndex}}, place);
    if (!result.contains("count")) source_.refuse(place + ".count", "is missing");
    for (const char* part : {"indices", "values"}) {
      const std::string here = place + "." + part;
      result[part] = source_.members(source_.object(given, part, place),
                                     {{"bufferView", Kind::kIndex},
                                      {"byteOffset", Kind::kIndex},
                                      {"componentType", Kind::kIndex}},
                                     here);
      settle_view(result[part], false, here);
    }
    if (!result["indices"].contains("componentType")) {
      source_.refuse(place + ".indices.componentType", "is missing");
    }
    return result;
  }

  // Views are made of perspective cameras; any other is taken as an orthographic one.
  json copy_camera(const json& given, const std::string& place) {
    const json type = source_.members(given, {{"type", Kind::kText}}, place);
    if (!type.contains("type")) source_.refuse(place + ".type", "is missing");
    if (type["type"] != "perspective") {
      const json lens = {{"xmag", 1}, {"ymag", 1}, {"zfar", 2}, {"znear", 1}};
      return {{"type", "orthographic"}, {"orthographic", lens}};
    }
    const std::string here = place + ".perspective";
    json lens = source_.members(source_.object(given, "perspective", place),
                                {{"yfov", Kind::kNumber}}, here);
    if (!lens.contains("yfov")) source_.refuse(here + ".yfov", "is missing");
    lens["znear"] = 1;
    return {{"type", "perspective"}, {"perspective", lens}};
  }

  const CheckedJson& source_;
  GltfDocument& document_;
  SceneWriter& writer_;
  size_t accessor_count_;
  size_t index_ = 0;  // of the element that is being copied
};

}  // namespace

json geometry_of(const CheckedJson& source, GltfDocument& document, SceneWriter& writer) {
  return GeometryFilter(source, document, writer).geometry();
}

}  // namespace sobb
