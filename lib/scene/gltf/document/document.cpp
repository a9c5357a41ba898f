// SPDX-License-Identifier: Apache-2.0
// See document.h.
#include "scene/gltf/document/document.h"

#include <climits>

#include "base/error.h"
#include "scene/gltf/document/checked_json.h"
#include "scene/gltf/document/declared_views.h"
#include "scene/gltf/document/extensions.h"
#include "scene/gltf/document/geometry_filter.h"

namespace sobb {
namespace {

using nlohmann::json;

// While a text is written it doubles, and the old one lives until it is copied.
constexpr uint64_t kGrowing = 3;

// The most that TinyGLTF's structs and ours take per element: a placed node with a camera.
constexpr uint64_t kElementBytes = 2560;

// The most that a buffer takes, without its URI: its declaration, its fault, what is fetched of it.
constexpr uint64_t kBufferBytes = 512;

// The most that a placeholder of geometry_of() takes more than the element that it stands for, in
// its tree and in its text: one of an accessor, a camera or a view, and any other.
constexpr uint64_t kLargePlaceholderBytes = 1024 + kGrowing * 96;
constexpr uint64_t kPlaceholderBytes = 192 + kGrowing * 8;

// A bound of the text that a tree is written to: numbers may become longer, as 1e15 does.
uint64_t written_bytes(const JsonSize& size) { return size.string_bytes + 4 * size.other_bytes; }

uint64_t size_of(const json& holder, const char* array) {
  const auto found = holder.find(array);
  return found != holder.end() ? found->size() : 0;
}

// Counts the elements of the document's arrays, their primitives, and the primitives' targets.
uint64_t count_elements(const json& document) {
  uint64_t count = 0;
  for (const json& part : document) {
    if (!part.is_array()) continue;
    count += part.size();
    for (const json& element : part) {
      if (size_of(element, "primitives") == 0) continue;
      count += element["primitives"].size();
      for (const json& primitive : element["primitives"]) count += size_of(primitive, "targets");
    }
  }
  return count;
}

uint64_t placeholder_bytes(const json& document) {
  const uint64_t large = 1 + size_of(document, "accessors") + size_of(document, "bufferViews") +
                         size_of(document, "cameras");
  return large * kLargePlaceholderBytes + count_elements(document) * kPlaceholderBytes;
}

// Counts what lives on until the scene is made: the model, with its strings and numbers, and the
// URIs.
void hold_document(const GltfDocument& document, const JsonSize& size, uint64_t elements,
                   SceneWriter& writer) {
  writer.hold(elements * kElementBytes + 2 * size.string_bytes + kGrowing * 8 * size.commas);
  for (const GltfBuffer& buffer : document.buffers) writer.hold(kBufferBytes + buffer.uri.size());
  for (const GltfView& view : document.views) {
    if (view.compressed) writer.hold(view.compressed->mode.size() + view.compressed->filter.size());
  }
}

// Error SCENE_UNSUPPORTED for another version than 2.x. A document of glTF 1.0 names its elements,
// and may name no version.
void check_version(const CheckedJson& checked) {
  const json& document = checked.document();
  const auto named = [&](const char* key) {
    const auto found = document.find(key);
    return found != document.end() && found->is_object();
  };
  std::string version;
  if (named("asset") && document["asset"].contains("version")) {
    const json& given = document["asset"]["version"];
    version = given.is_string() ? given.get<std::string>() : given.dump();
  }
  if (version == "1" || (version.empty() && (named("meshes") || named("nodes")))) version = "1.0";
  if (version == "2" || version.starts_with("2.")) return;
  if (version.empty()) checked.refuse("asset.version", "is missing");
  fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: glTF %s: only 2.x is read", checked.name().c_str(),
       version.substr(0, 20).c_str());
}

// What is left of the JSON for TinyGLTF.
struct FilteredText {
  std::string text;
  uint64_t elements = 0;
};

FilteredText filter_text(std::string_view text, GltfDocument& document, SceneWriter& writer) {
  const std::string& name = writer.name();
  const json tree = parse_json(text, name, writer);
  const JsonSize size = measure_json(text);
  check_json_room(2 * size.tree_bytes() + kGrowing * written_bytes(size) + placeholder_bytes(tree),
                  name, writer);
  const CheckedJson checked(tree, name);
  check_version(checked);
  check_extensions(checked, writer);
  document.buffers = declared_buffers(checked, document.faults);
  document.views = declared_views(checked, document.faults);
  const json geometry = geometry_of(checked, document, writer);
  FilteredText result{geometry.dump(), count_elements(geometry)};
  document.quantized = uses_extension(checked, "KHR_mesh_quantization");
  if (result.text.size() > UINT_MAX) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: JSON of 4 GiB or more", name.c_str());
  }
  return result;
}

void load_model(const std::string& text, const std::string& name, tinygltf::Model& model) {
  std::string error;
  std::string warning;
  tinygltf::TinyGLTF reader;
  const bool read =
      reader.LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), "");
  if (!read || !error.empty()) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s", name.c_str(),
         error.substr(0, error.find('\n')).c_str());
  }
}

}  // namespace

GltfDocument parse_gltf(std::string_view text, SceneWriter& writer) {
  GltfDocument result;
  const auto [filtered, elements] = filter_text(text, result, writer);
  const JsonSize size = measure_json(filtered);
  check_json_room(size.parse_bytes() + filtered.size() + elements * kElementBytes, writer.name(),
                  writer);
  hold_document(result, size, elements, writer);
  load_model(filtered, writer.name(), result.model);
  return result;
}

}  // namespace sobb
