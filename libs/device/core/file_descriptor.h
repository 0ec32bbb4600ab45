#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <utility>

namespace handway::device {

/// Owns a file descriptor of the system.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }

  void close() {
    if (fd_ >= 0) {
      ::close(std::exchange(fd_, -1));
    }
  }

  /// Reads and writes return at once, and programs started later don't inherit it.
  void make_nonblocking() const {
    ::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) | O_NONBLOCK);
    ::fcntl(fd_, F_SETFD, FD_CLOEXEC);
  }

  /// Waits until there is something to read. @returns whether there is.
  [[nodiscard]] bool wait_readable(std::chrono::microseconds timeout) const {
    pollfd waiting{fd_, POLLIN, 0};
    const timespec time{timeout.count() / 1000000, timeout.count() % 1000000 * 1000};
    return ::ppoll(&waiting, 1, &time, nullptr) > 0;
  }

 private:
  int fd_;
};

}  // namespace handway::device
