// SPDX-License-Identifier: Apache-2.0
// Names come from files as any bytes; the C interface promises UTF-8.
#pragma once

#include <string>

namespace sobb {

// The text with every byte that is no part of well-formed UTF-8 replaced by '?'.
std::string valid_utf8(std::string text);

}  // namespace sobb
