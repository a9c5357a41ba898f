// SPDX-License-Identifier: Apache-2.0
#include "format/writer/temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>

namespace sobb {
namespace {

// Linux transfers at most about 2 GiB per call.
constexpr uint64_t kWriteAtOnce = uint64_t{1} << 30;

}  // namespace

TemporaryFile::TemporaryFile(int folder, mode_t mode) : folder_(folder), file_(create(mode)) {}

TemporaryFile::~TemporaryFile() {
  if (file_.valid()) unlinkat(folder_, name_, 0);
}

// Locks the file, and returns whether it still has its name: before the lock another process may
// have taken the file for an abandoned one. On a file system without locks no file counts as
// abandoned.
bool TemporaryFile::own(int file) const {
  if (flock(file, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  struct stat opened;
  struct stat named;
  return fstat(file, &opened) == 0 && fstatat(folder_, name_, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// Removes the file of that name if no process holds its lock.
void TemporaryFile::remove_abandoned() const {
  const FileDescriptor file(openat(folder_, name_, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.valid() && flock(file.get(), LOCK_EX | LOCK_NB) == 0 && own(file.get())) {
    unlinkat(folder_, name_, 0);
  }
}

int TemporaryFile::create(mode_t mode) {
  for (unsigned number = 0;; ++number) {
    std::snprintf(name_, sizeof name_, ".sobb-%u.tmp", number);
    remove_abandoned();
    FileDescriptor file(openat(folder_, name_, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
    if (!file.valid() && errno != EEXIST) return -1;
    if (file.valid() && own(file.get())) return file.release();
  }
}

bool TemporaryFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        ::write(file_.get(), bytes.data(), std::min<uint64_t>(bytes.size(), kWriteAtOnce));
    if (count > 0) {
      bytes = bytes.subspan(static_cast<size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      if (count == 0) errno = ENOSPC;
      return false;
    }
  }
  return fsync(file_.get()) == 0;
}

bool TemporaryFile::rename(const char* name) {
  if (renameat(folder_, name_, folder_, name) != 0) return false;
  file_.close();
  return true;
}

}  // namespace sobb
