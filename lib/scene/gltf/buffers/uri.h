// SPDX-License-Identifier: Apache-2.0
// Understands the URIs of a glTF's buffers (RFC 3986; data URIs, RFC 2397) as writers spell them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/model/scene_writer.h"

namespace sobb {

bool is_data_uri(std::string_view uri);

// The bytes of a data URI, which the writer holds; none where it is malformed. Base64 may be
// percent-encoded, in lines, in the alphabet of URLs; without it the bytes are percent-encoded.
// Errors: MEMORY_LIMIT, CANCELLED.
std::optional<std::string> decode_data_uri(std::string_view uri, SceneWriter& writer);

// The paths, relative to the glTF's folder, that a file's URI may mean, the likeliest first; none
// for a URI with a scheme and for an absolute path.
std::vector<std::string> paths_of_uri(std::string_view uri);

}  // namespace sobb
