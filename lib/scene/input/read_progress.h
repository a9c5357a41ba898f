// SPDX-License-Identifier: Apache-2.0
// Reports, once per MiB of a file, how far its reader has come.
#pragma once

#include <cstdint>
#include <string_view>

#include "scene/model/scene_writer.h"

namespace sobb {

// It may be copied: readers look ahead, and read parts twice.
class ReadProgress {
 public:
  // `bytes` is the whole file. Without a writer nothing is reported.
  ReadProgress(std::string_view bytes, SceneWriter* writer)
      : begin_(bytes.data()), end_(bytes.data() + bytes.size()), writer_(writer) {
    next_ = writer == nullptr ? end_ : begin_;
  }

  // The reader is at this byte. Error CANCELLED.
  void at(const char* place) {
    if (place > next_) report(place);
  }

 private:
  void report(const char* place) {
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
