// SPDX-License-Identifier: Apache-2.0
// What a sobb_hierarchy handle holds.
#pragma once

#include <atomic>
#include <memory>

#include "base/memory.h"
#include "builder/build.h"
#include "format/image.h"
#include "format/view.h"
#include "sobb/sobb.h"
#include "trace/trace.h"

struct sobb_hierarchy {
  std::shared_ptr<sobb::Memory> memory;  // holds this object and the image
  sobb::Image image;
  sobb::FileView view;                // of the image
  sobb::Tracer tracer;                // likewise
  const sobb::TraceKernels* kernels;  // of the best instruction set, for calls without options
  sobb::BuildTimes times = {};
  uint64_t peak_bytes = 0;
  std::atomic<uint32_t> references{1};

  sobb_hierarchy(std::shared_ptr<sobb::Memory> memory, sobb::Image image,
                 const sobb::FileView& view);
};

namespace sobb {

// Makes a handle in its own memory, with one reference. Lifts the memory's limit, which was the
// call's.
sobb_hierarchy* make_hierarchy(std::shared_ptr<Memory> memory, Image image, const FileView& view);

}  // namespace sobb
