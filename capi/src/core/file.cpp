// SPDX-License-Identifier: Apache-2.0
// Saving and opening.
#include <utility>

#include "../guard.h"
#include "format/reader/reader.h"
#include "format/writer/writer.h"
#include "hierarchy.h"

using sobb::guard;
using sobb::Image;
using sobb::Memory;
using sobb::Progress;
using sobb::require;

namespace {

sobb_open_options read_open_options(const sobb_open_options* options) {
  const sobb_open_options known = sobb::read_options(options, "open options");
  if ((known.flags & ~static_cast<uint32_t>(SOBB_OPEN_MAP)) != 0 || known.reserved != 0) {
    sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "open options: flags are %#x, reserved is %u",
               known.flags, known.reserved);
  }
  return known;
}

// Validates an image and makes its handle; `name` is for messages.
sobb_hierarchy* open_image(std::shared_ptr<Memory> memory, Image image, const char* name,
                           const sobb_open_options& options, Progress& progress) {
  const sobb::Scheduler scheduler(options.threads, options.scheduler);
  const sobb::FileView view =
      sobb::read_image(std::as_const(image).bytes(), name, scheduler, *memory, progress);
  return sobb::make_hierarchy(std::move(memory), std::move(image), view);
}

}  // namespace

extern "C" {

sobb_status sobb_save(const sobb_hierarchy* hierarchy, const char* path) {
  return guard([&] {
    require(hierarchy, "hierarchy");
    require(path, "path");
    sobb::save_atomically(hierarchy->image.bytes(), path);
  });
}

sobb_status sobb_open(const char* path, const sobb_open_options* options, sobb_hierarchy** out) {
  return guard([&] {
    require(path, "path");
    require(out, "out");
    const sobb_open_options known = read_open_options(options);
    auto memory = std::make_shared<Memory>(known.allocator, known.memory_limit);
    Progress progress(known.progress, known.progress_user, "opening");
    Image image = (known.flags & SOBB_OPEN_MAP) != 0
                      ? Image::map(path)
                      : Image::read(memory, path, progress, sobb::kReadEnd);
    *out = open_image(std::move(memory), std::move(image), path, known, progress);
  });
}

sobb_status sobb_open_memory(const void* data, uint64_t size, const sobb_open_options* options,
                             sobb_hierarchy** out) {
  return guard([&] {
    require(data, "data");
    require(out, "out");
    const sobb_open_options known = read_open_options(options);
    if ((known.flags & SOBB_OPEN_MAP) != 0) {
      sobb::fail(SOBB_ERROR_INVALID_ARGUMENT, "open options: SOBB_OPEN_MAP is for files");
    }
    auto memory = std::make_shared<Memory>(known.allocator, known.memory_limit);
    Progress progress(known.progress, known.progress_user, "opening");
    Image image =
        Image::copy(memory, {static_cast<const std::byte*>(data), size}, progress, sobb::kReadEnd);
    *out = open_image(std::move(memory), std::move(image), "memory", known, progress);
  });
}

sobb_status sobb_bytes(const sobb_hierarchy* hierarchy, const void** data, uint64_t* size) {
  return guard([&] {
    require(hierarchy, "hierarchy");
    require(data, "data");
    require(size, "size");
    const auto bytes = hierarchy->image.bytes();
    *data = bytes.data();
    *size = bytes.size();
  });
}

}  // extern "C"
