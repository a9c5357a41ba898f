// SPDX-License-Identifier: Apache-2.0
// CheckedJson reads a glTF's JSON strictly: it copies wanted members, each checked for its type and
// range, and names the place of what is wrong.
#pragma once

#include <concepts>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "scene/input/json.h"

namespace sobb {

enum class JsonKind {
  kIndex,    // an integer from 0 to INT_MAX, as TinyGLTF's int holds it
  kSize,     // an integer from 0 to 2^53
  kNumber,   // any number
  kBool,     // true or false
  kText,     // a string
  kIndices,  // an array of kIndex
  kNumbers,  // an array of kNumber
};

struct JsonMember {
  const char* name;
  JsonKind kind;
  size_t length = 0;  // of kNumbers; 0 for any
};
using JsonMembers = std::initializer_list<JsonMember>;

// The object of an extension that `holder` holds; null where it holds none of that name.
const nlohmann::json* extension_of(const nlohmann::json& holder, const char* extension);

// Its functions throw SCENE_SYNTAX with the source's name and `place`, where in the document the
// value is.
class CheckedJson {
 public:
  // Both arguments are borrowed; `name` is the source.
  CheckedJson(const nlohmann::json& document, const std::string& name);

  const nlohmann::json& document() const { return document_; }
  const std::string& name() const { return name_; }

  [[noreturn]] void refuse(const std::string& place, const std::string& what) const {
    refuse_json(name_, place, what.c_str());
  }

  // Runs body(), and returns the place and fault with which it refuses; empty where it does not.
  template <std::invocable Body>
  std::string fault_of(const Body& body) const {
    try {
      body();
    } catch (const Error& error) {
      if (error.status != SOBB_ERROR_SCENE_SYNTAX) throw;
      return without_name(error.what());
    }
    return {};
  }

  // The member `key` of `parent`, which must be an object in an object.
  const nlohmann::json& object(const nlohmann::json& parent, const char* key,
                               const std::string& place) const;

  // A new object with those wanted members that the object `given` has.
  nlohmann::json members(const nlohmann::json& given, JsonMembers wanted,
                         const std::string& place) const;

  // Calls body(element, place) for each element of the array `key` of `parent`, if there is one.
  template <class Body>
  void for_each(const nlohmann::json& parent, const char* key, const std::string& prefix,
                const Body& body) const {
    const auto found = parent.find(key);
    if (found == parent.end()) return;
    if (!found->is_array()) refuse(prefix + key, "is not an array");
    for (size_t i = 0; i < found->size(); ++i) {
      body((*found)[i], prefix + key + "[" + std::to_string(i) + "]");
    }
  }

 private:
  std::string without_name(std::string message) const;
  nlohmann::json value(const nlohmann::json& given, const JsonMember& member,
                       const std::string& place) const;
  uint64_t integer(const nlohmann::json& given, double limit, const std::string& place) const;

  const nlohmann::json& document_;
  const std::string& name_;
};

}  // namespace sobb
