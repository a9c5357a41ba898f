// SPDX-License-Identifier: Apache-2.0
// See gltf_document.h.
#include "scene/gltf/document.h"

#include <climits>
#include <initializer_list>
#include <utility>

#include "base/error.h"
#include "scene/input/json.h"

namespace sobb {
namespace {

using nlohmann::json;

enum class Kind {
  kIndex,    // 0 to INT_MAX, as TinyGLTF's int holds it
  kSize,     // 0 to 2^53
  kNumber,   // any
  kBool,     //
  kText,     //
  kIndices,  // an array of kIndex
  kNumbers,  // an array of kNumber
};

struct Member {
  const char* name;
  Kind kind;
  size_t length = 0;  // of kNumbers; 0 for any
};
using Members = std::initializer_list<Member>;

class Filter {
 public:
  Filter(const json& document, const std::string& name) : document_(document), name_(name) {
    if (!document.is_object()) wrong("the document", "is not an object");
  }

  json filtered() const;
  std::vector<GltfBuffer> buffers() const;
  bool uses(const char* extension) const;
  void check_extensions() const;

 private:
  [[noreturn]] void wrong(const std::string& place, const char* what) const {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s %s", name_.c_str(), place.c_str(), what);
  }
  const json& object(const json& parent, const char* key, const std::string& place) const;
  json value(const json& given, const Member& member, const std::string& place) const;
  json members(const json& given, Members wanted, const std::string& place) const;
  void copy(json& to, const json& from, Members wanted, const std::string& place) const;

  // Calls body(element, place) for each object of the array `key`, if there is one.
  template <class Body>
  void for_each(const json& parent, const char* key, const std::string& prefix,
                const Body& body) const;
  template <class Convert>
  void convert_all(json& to, const char* key, const Convert& convert) const;

  json primitive(const json& given, const std::string& place) const;
  json mesh(const json& given, const std::string& place) const;
  json accessor(const json& given, const std::string& place) const;
  json camera(const json& given, const std::string& place) const;

  const json& document_;
  const std::string& name_;
};

json Filter::value(const json& given, const Member& member, const std::string& place) const {
  const std::string here = place + "." + member.name;
  switch (member.kind) {
    case Kind::kIndex:
    case Kind::kSize: {
      const double limit = member.kind == Kind::kIndex ? double(INT_MAX) : 0x1p53;
      const double number = given.is_number() ? given.get<double>() : -1;
      if (!(number >= 0 && number <= limit)) wrong(here, "is not an integer in range");
      const auto integer = uint64_t(number);
      if (double(integer) != number) wrong(here, "is not an integer");
      return integer;
    }
    case Kind::kNumber:
      if (!given.is_number()) wrong(here, "is not a number");
      return given;
    case Kind::kBool:
      if (!given.is_boolean()) wrong(here, "is not true or false");
      return given;
    case Kind::kText:
      if (!given.is_string()) wrong(here, "is not a string");
      return given;
    case Kind::kIndices:
    case Kind::kNumbers: {
      if (!given.is_array()) wrong(here, "is not an array");
      if (member.length != 0 && given.size() != member.length) wrong(here, "has a wrong length");
      const Kind kind = member.kind == Kind::kIndices ? Kind::kIndex : Kind::kNumber;
      json result = json::array();
      for (const json& element : given)
        result.push_back(value(element, {member.name, kind}, place));
      return result;
    }
  }
  return {};
}

void Filter::copy(json& to, const json& from, Members wanted, const std::string& place) const {
  if (!from.is_object()) wrong(place, "is not an object");
  for (const Member& member : wanted) {
    const auto found = from.find(member.name);
    if (found != from.end()) to[member.name] = value(*found, member, place);
  }
}

json Filter::members(const json& given, Members wanted, const std::string& place) const {
  json result = json::object();
  copy(result, given, wanted, place);
  return result;
}

const json& Filter::object(const json& parent, const char* key, const std::string& place) const {
  if (!parent.is_object()) wrong(place, "is not an object");
  const auto found = parent.find(key);
  if (found == parent.end() || !found->is_object()) wrong(place + "." + key, "is not an object");
  return *found;
}

template <class Body>
void Filter::for_each(const json& parent, const char* key, const std::string& prefix,
                      const Body& body) const {
  const auto found = parent.find(key);
  if (found == parent.end()) return;
  if (!found->is_array()) wrong(prefix + key, "is not an array");
  for (size_t i = 0; i < found->size(); ++i) {
    body((*found)[i], prefix + key + "[" + std::to_string(i) + "]");
  }
}

template <class Convert>
void Filter::convert_all(json& to, const char* key, const Convert& convert) const {
  for_each(document_, key, "", [&](const json& element, const std::string& place) {
    to[key].push_back(convert(element, place));
  });
}

json Filter::primitive(const json& given, const std::string& place) const {
  json result = members(given, {{"mode", Kind::kIndex}, {"indices", Kind::kIndex}}, place);
  const json& attributes = object(given, "attributes", place);
  result["attributes"] = members(attributes, {{"POSITION", Kind::kIndex}}, place);
  return result;
}

json Filter::mesh(const json& given, const std::string& place) const {
  json result = members(given, {{"name", Kind::kText}}, place);
  for_each(given, "primitives", place + ".", [&](const json& element, const std::string& here) {
    result["primitives"].push_back(primitive(element, here));
  });
  return result;
}

json Filter::accessor(const json& given, const std::string& place) const {
  json result = members(given,
                        {{"bufferView", Kind::kIndex},
                         {"byteOffset", Kind::kSize},
                         {"componentType", Kind::kIndex},
                         {"normalized", Kind::kBool},
                         {"count", Kind::kSize},
                         {"type", Kind::kText}},
                        place);
  if (!given.contains("sparse")) return result;
  const json& sparse = object(given, "sparse", place);
  json& copied = result["sparse"];
  copied = members(sparse, {{"count", Kind::kIndex}}, place + ".sparse");
  for (const char* part : {"indices", "values"}) {
    copied[part] = members(object(sparse, part, place + ".sparse"),
                           {{"bufferView", Kind::kIndex},
                            {"byteOffset", Kind::kIndex},
                            {"componentType", Kind::kIndex}},
                           place + ".sparse." + part);
  }
  return result;
}

json Filter::camera(const json& given, const std::string& place) const {
  json result = members(given, {{"type", Kind::kText}}, place);
  if (given.contains("perspective")) {
    result["perspective"] =
        members(object(given, "perspective", place),
                {{"yfov", Kind::kNumber}, {"znear", Kind::kNumber}}, place + ".perspective");
  }
  if (given.contains("orthographic")) {
    result["orthographic"] = members(object(given, "orthographic", place),
                                     {{"xmag", Kind::kNumber},
                                      {"ymag", Kind::kNumber},
                                      {"zfar", Kind::kNumber},
                                      {"znear", Kind::kNumber}},
                                     place + ".orthographic");
  }
  return result;
}

json Filter::filtered() const {
  json result = members(document_, {{"scene", Kind::kIndex}}, "the document");
  result["asset"] =
      members(object(document_, "asset", "the document"), {{"version", Kind::kText}}, "asset");
  convert_all(result, "scenes", [&](const json& given, const std::string& place) {
    return members(given, {{"nodes", Kind::kIndices}}, place);
  });
  convert_all(result, "nodes", [&](const json& given, const std::string& place) {
    return members(given,
                   {{"name", Kind::kText},
                    {"mesh", Kind::kIndex},
                    {"camera", Kind::kIndex},
                    {"children", Kind::kIndices},
                    {"matrix", Kind::kNumbers, 16},
                    {"translation", Kind::kNumbers, 3},
                    {"rotation", Kind::kNumbers, 4},
                    {"scale", Kind::kNumbers, 3}},
                   place);
  });
  convert_all(result, "meshes",
              [&](const json& given, const std::string& place) { return mesh(given, place); });
  convert_all(result, "accessors",
              [&](const json& given, const std::string& place) { return accessor(given, place); });
  convert_all(result, "bufferViews", [&](const json& given, const std::string& place) {
    return members(given,
                   {{"buffer", Kind::kIndex},
                    {"byteOffset", Kind::kSize},
                    {"byteLength", Kind::kSize},
                    {"byteStride", Kind::kSize}},
                   place);
  });
  convert_all(result, "cameras",
              [&](const json& given, const std::string& place) { return camera(given, place); });
  return result;
}

std::vector<GltfBuffer> Filter::buffers() const {
  std::vector<GltfBuffer> result;
  for_each(document_, "buffers", "", [&](const json& given, const std::string& place) {
    json copied = members(given, {{"byteLength", Kind::kSize}, {"uri", Kind::kText}}, place);
    if (!copied.contains("byteLength")) wrong(place + ".byteLength", "is missing");
    GltfBuffer& buffer = result.emplace_back();
    buffer.byte_length = copied["byteLength"].get<uint64_t>();
    if (copied.contains("uri")) buffer.uri = std::move(copied["uri"].get_ref<std::string&>());
  });
  return result;
}

bool Filter::uses(const char* extension) const {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = document_.find(list);
    if (found == document_.end() || !found->is_array()) continue;
    for (const json& element : *found) {
      if (element == extension) return true;
    }
  }
  return false;
}

// Extensions of what we ignore (materials, textures, lights) need no support.
void Filter::check_extensions() const {
  for_each(document_, "extensionsRequired", "", [&](const json& given, const std::string& place) {
    if (!given.is_string()) wrong(place, "is not a string");
    const auto& extension = given.get_ref<const std::string&>();
    if (extension == "KHR_mesh_quantization") return;
    for (const char* prefix : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                               "KHR_lights_", "KHR_xmp"}) {
      if (extension.starts_with(prefix)) return;
    }
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: requires the extension %s, which is not supported",
         name_.c_str(), extension.c_str());
  });
  // Not required, this one may be left out, but triangles would then be lost without a word.
  if (uses("EXT_mesh_gpu_instancing")) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: uses EXT_mesh_gpu_instancing, which is not supported",
         name_.c_str());
  }
}

// A text that is being written doubles, the old one living until it is copied.
constexpr uint64_t kGrowing = 3;

// What TinyGLTF's structs and ours take of an element, at most: a node with a camera, placed.
constexpr uint64_t kElementBytes = 2560;

// The text that a tree is written to: numbers may become longer, as 1e15 does.
uint64_t written_bytes(const JsonSize& size) { return size.string_bytes + 4 * size.other_bytes; }

uint64_t count_elements(const json& document) {
  uint64_t count = 0;
  for (const json& part : document) {
    if (!part.is_array()) continue;
    count += part.size();
    for (const json& element : part) {
      const auto primitives = element.find("primitives");
      if (primitives != element.end()) count += primitives->size();
    }
  }
  return count;
}

// What lives on until the scene is made: the model, with its strings and numbers, and the URIs.
void hold_document(const GltfDocument& document, const JsonSize& size, uint64_t elements,
                   SceneWriter& writer) {
  writer.hold(elements * kElementBytes + 2 * size.string_bytes + kGrowing * 8 * size.commas);
  for (const GltfBuffer& buffer : document.buffers) writer.hold(buffer.uri.size());
}

}  // namespace

GltfDocument parse_gltf(std::string_view text, SceneWriter& writer) {
  const std::string& name = writer.name();
  GltfDocument result;
  std::string filtered;
  uint64_t elements = 0;
  {
    const json document = parse_json(text, name, writer);
    const JsonSize size = measure_json(text);
    check_json_room(2 * size.tree_bytes() + kGrowing * written_bytes(size), name, writer);
    const Filter filter(document, name);
    filter.check_extensions();
    const json wanted = filter.filtered();
    elements = count_elements(wanted);
    filtered = wanted.dump();
    result.buffers = filter.buffers();
    result.quantized = filter.uses("KHR_mesh_quantization");
  }
  if (filtered.size() > UINT_MAX) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: JSON of 4 GiB or more", name.c_str());
  }
  const JsonSize size = measure_json(filtered);
  check_json_room(size.parse_bytes() + filtered.size() + elements * kElementBytes, name, writer);
  hold_document(result, size, elements, writer);
  std::string error;
  std::string warning;
  tinygltf::TinyGLTF reader;
  const bool read = reader.LoadASCIIFromString(&result.model, &error, &warning, filtered.data(),
                                               unsigned(filtered.size()), "");
  if (!read || !error.empty()) {
    fail(SOBB_ERROR_SCENE_SYNTAX, "%s: %s", name.c_str(),
         error.substr(0, error.find('\n')).c_str());
  }
  if (!result.model.asset.version.starts_with("2.")) {
    fail(SOBB_ERROR_SCENE_UNSUPPORTED, "%s: glTF version %s, only 2 is read", name.c_str(),
         result.model.asset.version.c_str());
  }
  return result;
}

}  // namespace sobb
