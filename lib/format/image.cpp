// SPDX-License-Identifier: Apache-2.0
#include "format/image.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "format/file_descriptor.h"
#include "format/layout.h"

namespace sobb {
namespace {

// Reading and copying report progress, and may be cancelled, after each piece of this size.
constexpr uint64_t kReadAtOnce = uint64_t{1} << 24;

// Opens a regular file and finds its size. Without O_NONBLOCK opening a FIFO would wait for a
// writer.
FileDescriptor open_regular(const char* path, uint64_t& size) {
  FileDescriptor file(open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status;
  if (!file.valid() || fstat(file.get(), &status) != 0) {
    fail(SOBB_ERROR_FILE_OPEN, "%s: %s", path, std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) fail(SOBB_ERROR_FILE_OPEN, "%s: %s", path, std::strerror(EISDIR));
  if (!S_ISREG(status.st_mode)) fail(SOBB_ERROR_FILE_OPEN, "%s: not a regular file", path);
  size = static_cast<uint64_t>(status.st_size);
  return file;
}

}  // namespace

Image::Image(std::shared_ptr<Memory> memory, uint64_t size) : size_(size) {
  if (size == 0) return;
  data_ = static_cast<std::byte*>(memory->allocate(size, kSectionAlignment));
  memory_ = std::move(memory);
}

Image Image::allocate(std::shared_ptr<Memory> memory, uint64_t size, uint64_t zeroed) {
  Image image(std::move(memory), size);
  if (image.data_ != nullptr) std::memset(image.data_, 0, zeroed);
  return image;
}

Image Image::read(std::shared_ptr<Memory> memory, const char* path, Progress& progress,
                  double progress_end) {
  uint64_t size = 0;
  const FileDescriptor file = open_regular(path, size);
  Image image(std::move(memory), size);
  ProgressStage stage(progress, 0, progress_end, size);
  for (uint64_t done = 0; done < size;) {
    const ssize_t count =
        ::read(file.get(), image.data_ + done, std::min(size - done, kReadAtOnce));
    if (count < 0) {
      if (errno == EINTR) continue;
      fail(SOBB_ERROR_FILE_READ, "%s: byte %llu: %s", path, static_cast<unsigned long long>(done),
           std::strerror(errno));
    }
    if (count == 0) {
      fail(SOBB_ERROR_FILE_READ, "%s: became shorter while it was read: %llu bytes of %llu", path,
           static_cast<unsigned long long>(done), static_cast<unsigned long long>(size));
    }
    done += static_cast<uint64_t>(count);
    stage.advance(static_cast<uint64_t>(count));
  }
  return image;
}

Image Image::copy(std::shared_ptr<Memory> memory, std::span<const std::byte> bytes,
                  Progress& progress, double progress_end) {
  Image image(std::move(memory), bytes.size());
  ProgressStage stage(progress, 0, progress_end, bytes.size());
  for (uint64_t done = 0; done < bytes.size();) {
    const auto piece = bytes.subspan(done, std::min(bytes.size() - done, kReadAtOnce));
    std::ranges::copy(piece, image.data_ + done);
    done += piece.size();
    stage.advance(piece.size());
  }
  return image;
}

Image Image::map(const char* path) {
  Image image;
  const FileDescriptor file = open_regular(path, image.size_);
  if (image.size_ == 0) return image;
  void* const data = mmap(nullptr, image.size_, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (data == MAP_FAILED) {
    image.size_ = 0;
    fail(SOBB_ERROR_FILE_READ, "%s: cannot map it: %s", path, std::strerror(errno));
  }
  image.data_ = static_cast<std::byte*>(data);
  return image;
}

Image::Image(Image&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      memory_(std::move(other.memory_)) {}

Image& Image::operator=(Image&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(memory_, other.memory_);
  return *this;
}

Image::~Image() {
  if (data_ == nullptr) return;
  if (memory_) {
    memory_->deallocate(data_, size_, kSectionAlignment);
  } else {
    munmap(data_, size_);
  }
}

}  // namespace sobb
