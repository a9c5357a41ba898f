// SPDX-License-Identifier: Apache-2.0
// Makes names UTF-8, as the C interface promises: files hold any bytes.
#pragma once

#include <string>

namespace sobb {

// The text with every byte that is no part of well-formed UTF-8 replaced by '?'.
std::string valid_utf8(std::string text);

}  // namespace sobb
