// SPDX-License-Identifier: Apache-2.0
// See extensions.h.
#include "scene/gltf/document/extensions.h"

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "base/error.h"

namespace sobb {
namespace {

using nlohmann::json;
using Names = std::set<std::string_view>;  // keys of the document

constexpr std::string_view kRead[] = {"KHR_mesh_quantization", "KHR_draco_mesh_compression",
                                      "KHR_meshopt_compression", "EXT_meshopt_compression",
                                      "KHR_node_visibility"};

// Extensions that change triangles only where an object of the document holds them.
constexpr std::string_view kHeldByGeometry[] = {"EXT_mesh_gpu_instancing", "CESIUM_RTC",
                                                "AGI_articulations",       "MPEG_mesh_linking",
                                                "MPEG_accessor_timed",     "MPEG_buffer_circular"};

// Extensions of what is ignored anyway, by the beginning of what follows the vendor's prefix:
// materials, textures, lights, animation, sound, physics, points, metadata, editors' and players'
// data, and finer or coarser versions of meshes that are there.
constexpr std::string_view kIgnoredKinds[] = {"materials",
                                              "texture",
                                              "lights",
                                              "lightmap",
                                              "image",
                                              "packing",
                                              "technique",
                                              "environment",
                                              "animation",
                                              "audio",
                                              "physics",
                                              "implicit_shapes",
                                              "interactivity",
                                              "node_hover",
                                              "node_select",
                                              "gaussian",
                                              "xmp",
                                              "structural",
                                              "mesh_features",
                                              "instance_features",
                                              "feature_metadata",
                                              "stk_metadata",
                                              "bim_data",
                                              "geometry_metadata",
                                              "primitive_outline",
                                              "mesh_manifold",
                                              "ngon",
                                              "bmesh_encoding",
                                              "single_root",
                                              "hubs_components",
                                              "components",
                                              "viewport",
                                              "lod",
                                              "mesh_variants",
                                              "progressive"};

bool is_ignored(std::string_view extension) {
  if (extension == "VRM" || extension.starts_with("VRMC_")) return true;
  const std::string_view kind = extension.substr(extension.find('_') + 1);  // npos + 1 is 0
  return std::ranges::any_of(kIgnoredKinds,
                             [&](std::string_view known) { return kind.starts_with(known); });
}

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

void add_held(const json& holder, Names& names) {
  const auto found = holder.find("extensions");
  if (found == holder.end() || !found->is_object()) return;
  for (const auto& item : found->items()) names.insert(item.key());
}

// The extensions that objects of the geometry hold: the document itself, and the elements of these
// arrays.
Names held_by_geometry(const json& document) {
  Names names;
  add_held(document, names);
  for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers"}) {
    const auto array = document.find(key);
    if (array == document.end() || !array->is_array()) continue;
    for (const json& element : *array) {
      add_held(element, names);
      const auto primitives = element.find("primitives");
      if (primitives == element.end() || !primitives->is_array()) continue;
      for (const json& primitive : *primitives) add_held(primitive, names);
    }
  }
  return names;
}

// The extensions that any object below `value` holds. (parse_json() bounds the depth.)
void add_held_below(const json& value, Names& names) {
  add_held(value, names);
  for (const json& element : value) {
    if (element.is_structured()) add_held_below(element, names);
  }
}

class ExtensionCheck {
 public:
  ExtensionCheck(const CheckedJson& json, SceneWriter& writer)
      : json_(json), writer_(writer), geometry_(held_by_geometry(json.document())) {}

  void check_required(const std::string& extension) {
    if (is_one_of(kRead, extension)) return;
    const bool held = geometry_.count(extension) != 0;
    const bool harmless =
        is_ignored(extension) ||
        (!held && (is_one_of(kHeldByGeometry, extension) || held_at_all(extension)));
    if (!harmless) refuse("requires", extension);
    writer_.note(SOBB_NOTE_EXTENSION,
                 [&] { return "the required extension " + extension + " was not read"; });
  }

  // A file may use this one without requiring it, but its instances would be lost without a word.
  void check_instancing() const {
    constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
    if (geometry_.count(kInstancing) != 0) refuse("uses", kInstancing);
  }

 private:
  // An unknown extension that only materials, images or the like hold moves no triangle.
  bool held_at_all(const std::string& extension) {
    if (anywhere_.empty()) add_held_below(json_.document(), anywhere_);
    return anywhere_.count(extension) != 0;
  }

  [[noreturn]] void refuse(const char* how, const std::string& extension) const {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: %s the extension %s, which is not supported",
         json_.name().c_str(), how, extension.c_str());
  }

  const CheckedJson& json_;
  SceneWriter& writer_;
  Names geometry_;
  Names anywhere_;
};

}  // namespace

bool uses_extension(const CheckedJson& json, const char* extension) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = json.document().find(list);
    if (found == json.document().end() || !found->is_array()) continue;
    if (std::find(found->begin(), found->end(), extension) != found->end()) return true;
  }
  return false;
}

void check_extensions(const CheckedJson& json, SceneWriter& writer) {
  ExtensionCheck check(json, writer);
  json.for_each(json.document(), "extensionsRequired", "",
                [&](const nlohmann::json& given, const std::string& place) {
                  if (!given.is_string()) json.refuse(place, "is not a string");
                  writer.work(1);
                  check.check_required(given.get_ref<const std::string&>());
                });
  check.check_instancing();
}

}  // namespace sobb
