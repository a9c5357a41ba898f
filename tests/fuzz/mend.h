// SPDX-License-Identifier: Apache-2.0
// Mends any bytes so that they pass the checks of a .sobb file that noise never passes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sobb::fuzz {

// A copy with the magic, version, sizes and checksums that a reader wants.
std::vector<std::byte> mended(std::span<const std::byte> bytes);

}  // namespace sobb::fuzz
