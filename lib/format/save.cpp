// SPDX-License-Identifier: Apache-2.0
// Replacing a file whole or not at all.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "base/error.h"
#include "format/file_descriptor.h"
#include "format/writer.h"

namespace sobb {
namespace {

// Linux transfers at most about 2 GiB a call.
constexpr uint64_t kWriteAtOnce = uint64_t{1} << 30;

[[noreturn]] void fail_write(const char* path, const char* doing) {
  fail(SOBB_ERROR_FILE_WRITE, "%s: %s: %s", path, doing, std::strerror(errno));
}

// Where `path` leads: a link that leads somewhere is kept, and what it leads to replaced.
std::string resolve(const char* path) {
  const std::unique_ptr<char, decltype(&std::free)> resolved(realpath(path, nullptr), std::free);
  return resolved ? resolved.get() : path;
}

// The permissions for the new file, before the umask: those of the file that it replaces.
mode_t mode_for(int folder, const char* name, const char* path) {
  struct stat old;
  if (fstatat(folder, name, &old, 0) != 0) {
    if (errno != ENOENT) fail_write(path, "cannot be replaced");
    return 0666;
  }
  if (!S_ISREG(old.st_mode)) fail(SOBB_ERROR_FILE_WRITE, "%s: not a regular file", path);
  return old.st_mode & 0777;
}

// A new file in a folder, which is removed again unless it was renamed.
class Temporary {
 public:
  Temporary(int folder, mode_t mode) : folder_(folder), file_(create(mode)) {}
  ~Temporary() {
    if (file_.valid()) unlinkat(folder_, name_, 0);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  bool created() const { return file_.valid(); }

  bool write(std::span<const std::byte> bytes) {
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

  bool rename(const char* name) {
    if (renameat(folder_, name_, folder_, name) != 0) return false;
    file_.close();
    return true;
  }

 private:
  // Unique among processes and threads, and short: the target's name may already be as long as the
  // file system allows.
  int create(mode_t mode) {
    static std::atomic<unsigned> counter{0};
    int file;
    do {
      std::snprintf(name_, sizeof name_, ".sobb-%ld-%u.tmp", static_cast<long>(getpid()),
                    counter.fetch_add(1, std::memory_order_relaxed));
      file = openat(folder_, name_, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    } while (file < 0 && errno == EEXIST);
    return file;
  }

  int folder_;
  char name_[48];
  FileDescriptor file_;
};

}  // namespace

void save_atomically(std::span<const std::byte> bytes, const char* path) {
  const std::string target = resolve(path);
  const size_t slash = target.rfind('/');
  const std::string folder_path = slash == std::string::npos ? "." : target.substr(0, slash + 1);
  const char* const name = target.c_str() + (slash == std::string::npos ? 0 : slash + 1);

  const FileDescriptor folder(open(folder_path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.valid()) fail_write(path, "cannot open its folder");
  Temporary temporary(folder.get(), mode_for(folder.get(), name, path));
  if (!temporary.created()) fail_write(path, "cannot create a file in its folder");
  if (!temporary.write(bytes)) fail_write(path, "cannot write");
  if (!temporary.rename(name)) fail_write(path, "cannot be replaced");
  // The new file is whole and in place whatever this says: all that could fail is that a power cut
  // now brings the old one back.
  fsync(folder.get());
}

}  // namespace sobb
