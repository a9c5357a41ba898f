// SPDX-License-Identifier: Apache-2.0
// See checked_json.h.
#include "scene/gltf/document/checked_json.h"

#include <climits>

namespace sobb {

using nlohmann::json;

const json* extension_of(const json& holder, const char* extension) {
  const auto extensions = holder.find("extensions");
  if (extensions == holder.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(extension);
  return found == extensions->end() ? nullptr : &*found;
}

CheckedJson::CheckedJson(const json& document, const std::string& name)
    : document_(document), name_(name) {
  if (!document.is_object()) refuse("the document", "is not an object");
}

std::string CheckedJson::without_name(std::string message) const {
  if (message.starts_with(name_ + ": ")) message.erase(0, name_.size() + 2);
  return message;
}

const json& CheckedJson::object(const json& parent, const char* key,
                                const std::string& place) const {
  if (!parent.is_object()) refuse(place, "is not an object");
  const auto found = parent.find(key);
  if (found == parent.end() || !found->is_object()) refuse(place + "." + key, "is not an object");
  return *found;
}

json CheckedJson::members(const json& given, JsonMembers wanted, const std::string& place) const {
  if (!given.is_object()) refuse(place, "is not an object");
  json result = json::object();
  for (const JsonMember& member : wanted) {
    const auto found = given.find(member.name);
    if (found != given.end()) result[member.name] = value(*found, member, place);
  }
  return result;
}

uint64_t CheckedJson::integer(const json& given, double limit, const std::string& place) const {
  const double number = given.is_number() ? given.get<double>() : -1;
  if (!(number >= 0 && number <= limit)) refuse(place, "is not an integer in range");
  const auto integer = uint64_t(number);
  if (double(integer) != number) refuse(place, "is not an integer");
  return integer;
}

json CheckedJson::value(const json& given, const JsonMember& member,
                        const std::string& place) const {
  const std::string here = place + "." + member.name;
  switch (member.kind) {
    case JsonKind::kIndex:
      return integer(given, INT_MAX, here);
    case JsonKind::kSize:
      return integer(given, 0x1p53, here);
    case JsonKind::kNumber:
      if (!given.is_number()) refuse(here, "is not a number");
      return given;
    case JsonKind::kBool:
      if (!given.is_boolean()) refuse(here, "is not true or false");
      return given;
    case JsonKind::kText:
      if (!given.is_string()) refuse(here, "is not a string");
      return given;
    case JsonKind::kIndices:
    case JsonKind::kNumbers: {
      if (!given.is_array()) refuse(here, "is not an array");
      if (member.length != 0 && given.size() != member.length) refuse(here, "has a wrong length");
      const bool indices = member.kind == JsonKind::kIndices;
      const JsonKind kind = indices ? JsonKind::kIndex : JsonKind::kNumber;
      json result = json::array();
      for (const json& element : given) {
        result.push_back(value(element, {member.name, kind}, place));
      }
      return result;
    }
  }
  return {};
}

}  // namespace sobb
