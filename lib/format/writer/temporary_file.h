// SPDX-License-Identifier: Apache-2.0
// A file that is being written beside the one that it will replace.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>

#include "format/file_descriptor.h"

namespace sobb {

// The file is named `.sobb-N.tmp`, N from 0 on, and removed again unless it was renamed. A killed
// process leaves its file, but not the lock on it: the next process to use that name removes the
// file. So a folder never keeps more such files than were once written in it at the same time.
class TemporaryFile {
 public:
  // `folder` is an open directory's descriptor; `mode` is taken before the umask.
  TemporaryFile(int folder, mode_t mode);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  // Each returns false with errno set where it fails.
  bool created() const { return file_.valid(); }
  bool write(std::span<const std::byte> bytes);  // and brings them to the disk
  bool rename(const char* name);                 // within the folder, over what is there

 private:
  int create(mode_t mode);
  bool own(int file) const;
  void remove_abandoned() const;

  int folder_;
  char name_[32];  // short: the target's own may already be as long as the file system allows
  FileDescriptor file_;
};

}  // namespace sobb
