#include "core/links.h"
#include "core/ports.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

namespace handway::device {
namespace {

/// The reading end of a pipe.
class PipeLink final : public ByteLink {
 public:
  PipeLink(std::string name, FileDescriptor pipe)
      : ByteLink(std::move(name)), pipe_(std::move(pipe)) {}

 private:
  std::size_t do_read(std::span<std::uint8_t> bytes, std::chrono::milliseconds timeout) override {
    if (!pipe_.wait_readable(timeout)) {
      return 0;
    }
    const ssize_t count = ::read(pipe_.get(), bytes.data(), bytes.size());
    if (count > 0) {
      return static_cast<std::size_t>(count);
    }
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
      return 0;
    }
    throw EndOfInput({name(), "", count == 0 ? "the end of the input" : std::strerror(errno),
                      "a program that writes", "Look whether the program before the pipe runs."});
  }

  void do_write(std::span<const std::uint8_t> /*bytes*/,
                std::chrono::milliseconds /*timeout*/) override {
    throw DeviceError({name(), "", "a pipe, which is only read", "a device that takes commands",
                       "Name a serial port or HOST:PORT."});
  }

  FileDescriptor pipe_;
};

FileDescriptor opened_pipe(const std::string& name, const std::string& path) {
  constexpr const char* kExpected = "a named pipe";
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    throw DeviceError({name, "", std::strerror(errno), kExpected, "Make it with: mkfifo " + path});
  }
  if (!S_ISFIFO(status.st_mode)) {
    throw DeviceError({name, "", "a file or folder that is no pipe", kExpected,
                       "Recordings are read with handway glove replay."});
  }
  // Opened for writing, too, it does not end with its first writer.
  FileDescriptor pipe(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (!pipe.valid()) {
    throw DeviceError(
        {name, "", std::strerror(errno), "a pipe that may be read", "Check its permissions."});
  }
  return pipe;
}

}  // namespace

std::unique_ptr<ByteLink> open_pipe_link(const std::string& name, const std::string& path) {
  return std::make_unique<PipeLink>(name, opened_pipe(name, path));
}

std::unique_ptr<ByteLink> open_standard_input(const std::string& name) {
  FileDescriptor input(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0));
  if (!input.valid()) {
    throw DeviceError({name, "", "no standard input", "a pipe from a program that writes", ""});
  }
  return std::make_unique<PipeLink>(name, std::move(input));
}

}  // namespace handway::device
