// SPDX-License-Identifier: Apache-2.0
// Decodes Base64 (RFC 4648, section 4), for data URIs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sobb {

// The bytes that `text` encodes, with or without padding; nothing where it is malformed.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace sobb
