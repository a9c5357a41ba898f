// SPDX-License-Identifier: Apache-2.0
// The targets that open a .sobb file from memory.
#include <cstring>
#include <vector>

#include "fuzz/heap_watch.h"
#include "fuzz/mend.h"
#include "fuzz/targets.h"
#include "sobb/sobb.h"

namespace sobb::fuzz {
namespace {

// Opening takes the file's size and that of its proof: a byte per node and a bit per block, each of
// which has at least 128 bytes in the file.
constexpr uint64_t memory_for(uint64_t size) { return size + size / 64 + 4096; }

// Messages and bookkeeping are not counted.
constexpr int64_t kBookkeeping = 64 << 10;

bool is_refusal_of_a_file(sobb_status status) {
  return status >= SOBB_ERROR_FORMAT_MAGIC && status <= SOBB_ERROR_FORMAT_RECORD;
}

void open_and_release(Bytes bytes) {
  if (bytes.empty()) return;
  sobb_open_options options = {};
  options.struct_size = sizeof options;
  options.threads = 1;
  options.memory_limit = memory_for(bytes.size());
  sobb_hierarchy* hierarchy = nullptr;
  const HeapWatch heap;
  const sobb_status status = sobb_open_memory(bytes.data(), bytes.size(), &options, &hierarchy);
  expect(heap.peak() <= static_cast<int64_t>(options.memory_limit) + kBookkeeping,
         "opening stays within its memory limit");
  if (status != SOBB_OK) {
    expect(is_refusal_of_a_file(status), "a file is refused with a status of the format");
    expect(std::strlen(sobb_last_error()) > 0, "a refusal has a message");
    expect(hierarchy == nullptr, "a refusal leaves the output alone");
    return;
  }
  const void* data = nullptr;
  uint64_t size = 0;
  expect(sobb_bytes(hierarchy, &data, &size) == SOBB_OK && size == bytes.size() &&
             std::memcmp(data, bytes.data(), size) == 0,
         "what was opened is what was given");
  sobb_release(hierarchy);
}

}  // namespace

void open(Bytes bytes) { open_and_release(bytes); }

void open_mended(Bytes bytes) { open_and_release(mended(bytes)); }

}  // namespace sobb::fuzz
