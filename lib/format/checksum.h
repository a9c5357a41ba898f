// SPDX-License-Identifier: Apache-2.0
// The two checksums of a file; docs/format.md defines them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "base/progress.h"
#include "base/scheduler.h"
#include "format/layout.h"

namespace sobb {

// XXH3-64 of the header and the section table, the header's own checksum taken as zero. `front` is
// their bytes; there are at most kMaxSections sections.
uint64_t header_checksum(std::span<const std::byte> front);

// XXH3-64 over the XXH3-64 of each MiB, so that a large section is checked in parallel. Meanwhile
// `scratch` holds eight bytes per MiB. `stage`, which may be null, counts bytes.
uint64_t section_checksum(std::span<const std::byte> section, const Scheduler& scheduler,
                          std::pmr::memory_resource& scratch, ProgressStage* stage = nullptr);

}  // namespace sobb
