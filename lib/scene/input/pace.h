// SPDX-License-Identifier: Apache-2.0
// How a reader tells, once a MiB of its file, how far it has come.
#pragma once

#include <cstdint>
#include <string_view>

#include "scene/scene_writer.h"

namespace sobb {

// May be copied: readers look ahead, and read parts twice.
class Pace {
 public:
  // `bytes` is the whole; without a writer nobody is told.
  Pace(std::string_view bytes, SceneWriter* writer)
      : begin_(bytes.data()), end_(bytes.data() + bytes.size()), writer_(writer) {
    next_ = writer == nullptr ? end_ : begin_;
  }

  // The reader is at this byte. Throws where the caller wants to stop.
  void at(const char* place) {
    if (place > next_) tell(place);
  }

 private:
  void tell(const char* place) {
    constexpr int64_t kStep = 1 << 20;
    if (writer_ == nullptr) return;
    writer_->reach(static_cast<double>(place - begin_) / static_cast<double>(end_ - begin_));
    next_ = end_ - place > kStep ? place + kStep : end_;
  }

  const char* begin_;
  const char* end_;
  const char* next_;
  SceneWriter* writer_;
};

}  // namespace sobb
