// SPDX-License-Identifier: Apache-2.0
// Replaces a file whole or not at all.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "base/error.h"
#include "format/file_descriptor.h"
#include "format/writer/temporary_file.h"
#include "format/writer/writer.h"

namespace sobb {
namespace {

[[noreturn]] void fail_write(const char* path, const char* doing) {
  fail(SOBB_ERROR_FILE_WRITE, "%s: %s: %s", path, doing, std::strerror(errno));
}

// Finds where `path` leads: a link that leads somewhere stays, and its target is replaced.
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

}  // namespace

void save_atomically(std::span<const std::byte> bytes, const char* path) {
  const std::string target = resolve(path);
  const size_t slash = target.rfind('/');
  const std::string folder_path = slash == std::string::npos ? "." : target.substr(0, slash + 1);
  const char* const name = target.c_str() + (slash == std::string::npos ? 0 : slash + 1);

  const FileDescriptor folder(open(folder_path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder.valid()) fail_write(path, "cannot open its folder");
  TemporaryFile temporary(folder.get(), mode_for(folder.get(), name, path));
  if (!temporary.created()) fail_write(path, "cannot create a file in its folder");
  if (!temporary.write(bytes)) fail_write(path, "cannot write");
  if (!temporary.rename(name)) fail_write(path, "cannot be replaced");
  // The new file is whole and in place whatever fsync() returns. If it fails, a power cut now may
  // bring the old file back.
  fsync(folder.get());
}

}  // namespace sobb
