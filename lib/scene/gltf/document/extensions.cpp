// SPDX-License-Identifier: Apache-2.0
// See extensions.h.
#include "scene/gltf/document/extensions.h"

#include <algorithm>

#include "base/error.h"

namespace sobb {
namespace {

constexpr const char* kSupported[] = {"KHR_mesh_quantization"};

// Extensions of what is ignored anyway (materials, textures, lights, metadata) need no support.
constexpr const char* kIgnoredPrefixes[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                            "MSFT_texture_",  "KHR_lights_",  "KHR_xmp"};

bool may_be_required(const std::string& extension) {
  const auto is_prefix = [&](const char* prefix) { return extension.starts_with(prefix); };
  return std::find(std::begin(kSupported), std::end(kSupported), extension) !=
             std::end(kSupported) ||
         std::ranges::any_of(kIgnoredPrefixes, is_prefix);
}

}  // namespace

bool uses_extension(const CheckedJson& json, const char* extension) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = json.document().find(list);
    if (found == json.document().end() || !found->is_array()) continue;
    if (std::find(found->begin(), found->end(), extension) != found->end()) return true;
  }
  return false;
}

void check_extensions(const CheckedJson& json) {
  json.for_each(json.document(), "extensionsRequired", "",
                [&](const nlohmann::json& given, const std::string& place) {
                  if (!given.is_string()) json.refuse(place, "is not a string");
                  const auto& extension = given.get_ref<const std::string&>();
                  if (may_be_required(extension)) return;
                  fail(SOBB_ERROR_SCENE_UNSUPPORTED,
                       "%s: requires the extension %s, which is not supported", json.name().c_str(),
                       extension.c_str());
                });
  // A file may use this one without requiring it, but its instances would be lost without a word.
  if (uses_extension(json, "EXT_mesh_gpu_instancing")) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: uses EXT_mesh_gpu_instancing, which is not supported",
         json.name().c_str());
  }
}

}  // namespace sobb
