// SPDX-License-Identifier: Apache-2.0
// Makes of any bytes what gets past the checks that noise never passes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sobb::fuzz {

// A copy with magic, version, sizes and checksums as a reader wants them.
std::vector<std::byte> mended(std::span<const std::byte> bytes);

}  // namespace sobb::fuzz
