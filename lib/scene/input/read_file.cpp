// SPDX-License-Identifier: Apache-2.0
// See read_file.h.
#include "scene/input/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "base/error.h"

namespace sobb {
namespace {

constexpr size_t kReadAtOnce = size_t(1) << 24;  // progress is reported between them

std::string system_reason() { return std::generic_category().message(errno); }

class Descriptor {
 public:
  // O_NONBLOCK: opening a pipe would wait for its writer.
  explicit Descriptor(const std::string& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

FileBytes read_file(const std::string& path, SceneWriter& writer) {
  const Descriptor file(path);
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
    fail(SOBB_ERROR_FILE_OPEN, "%s: %s", path.c_str(), system_reason().c_str());
  }
  if (!S_ISREG(status.st_mode)) {
    fail(SOBB_ERROR_FILE_OPEN, "%s: not a regular file", path.c_str());
  }
  FileBytes bytes;
  bytes.size = size_t(status.st_size);
  if (bytes.size > writer.memory_left()) {
    fail(SOBB_ERROR_MEMORY_LIMIT, "%s: the file's %zu bytes exceed the memory limit", path.c_str(),
         bytes.size);
  }
  bytes.data = std::make_unique_for_overwrite<char[]>(bytes.size);
  size_t done = 0;
  while (done < bytes.size) {
    writer.work(kReadAtOnce);
    const size_t step = std::min<size_t>(bytes.size - done, kReadAtOnce);
    const ssize_t got = ::read(file.number(), bytes.data.get() + done, step);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      fail(SOBB_ERROR_FILE_READ, "%s: after %zu of %zu bytes: %s", path.c_str(), done, bytes.size,
           got < 0 ? system_reason().c_str() : "the file became shorter");
    }
    done += size_t(got);
  }
  return bytes;
}

bool file_exists(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0;
}

}  // namespace sobb
