// SPDX-License-Identifier: Apache-2.0
// See uri.h.
#include "scene/gltf/buffers/uri.h"

#include <algorithm>

#include "scene/input/base64.h"

namespace sobb {
namespace {

constexpr std::string_view kScheme = "data:";
constexpr std::string_view kBase64 = ";base64";

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

bool equal_in_any_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, lower, lower);
}

int hex_digit(char c) {
  c = lower(c);
  if (c >= '0' && c <= '9') return c - '0';
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

// The URI with its percent-encoded bytes (RFC 3986, section 2.1) decoded.
std::string unescaped(std::string_view uri) {
  std::string result;
  result.reserve(uri.size());
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                        hex_digit(uri[i + 2]) >= 0;
    result += escape ? char(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return result;
}

// Takes the space out of Base64, and the letters of the alphabet of URLs (RFC 4648, section 5).
void tidy_base64(std::string& text) {
  std::erase_if(text, [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); });
  std::ranges::replace(text, '-', '+');
  std::ranges::replace(text, '_', '/');
}

bool has_scheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  return colon != std::string_view::npos && uri.find('/') > colon;
}

bool is_relative(std::string_view path) {
  return !path.empty() && !path.starts_with('/') && path.find('\0') == std::string_view::npos;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return equal_in_any_case(uri.substr(0, kScheme.size()), kScheme);
}

std::optional<std::string> decode_data_uri(std::string_view uri, SceneWriter& writer) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  std::string_view type = uri.substr(0, comma);
  while (type.ends_with(' ')) type.remove_suffix(1);
  const bool base64 = type.size() >= kBase64.size() &&
                      equal_in_any_case(type.substr(type.size() - kBase64.size()), kBase64);
  const std::string_view content = uri.substr(comma + 1);
  writer.work(content.size() / 16);
  writer.hold(base64 ? content.size() / 4 * 3 + 2 : content.size());
  if (!base64) return unescaped(content);
  if (content.find_first_of("%-_ \t\n\v\f\r") == std::string_view::npos) {
    return decode_base64(content);
  }
  writer.check_room(content.size());
  std::string tidy = unescaped(content);
  tidy_base64(tidy);
  return decode_base64(tidy);
}

std::vector<std::string> paths_of_uri(std::string_view uri) {
  std::vector<std::string> paths;
  if (has_scheme(uri)) return paths;
  // A file may be named as the URI is spelled, and may be asked for with a query or a fragment.
  const std::string decoded = unescaped(uri);
  const std::string spelled(uri);
  const std::string asked_for = unescaped(uri.substr(0, uri.find_first_of("?#")));
  std::string slashes = decoded;
  std::ranges::replace(slashes, '\\', '/');
  for (const std::string& path : {decoded, spelled, asked_for, slashes}) {
    if (is_relative(path) && std::ranges::find(paths, path) == paths.end()) paths.push_back(path);
  }
  return paths;
}

}  // namespace sobb
