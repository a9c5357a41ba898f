// SPDX-License-Identifier: Apache-2.0
// An open file that closes itself.
#pragma once

#include <unistd.h>

#include <utility>

namespace sobb {

class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor() { close(); }

  bool valid() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  // Hands the file over.
  int release() { return std::exchange(descriptor_, -1); }
  // The status of close(2): some file systems report a failed write only here.
  int close() { return valid() ? ::close(std::exchange(descriptor_, -1)) : 0; }

 private:
  int descriptor_;
};

}  // namespace sobb
