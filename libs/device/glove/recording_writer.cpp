#include "handway/device/glove/recording_writer.h"

#include "handway/geometric/io/input_error.h"
#include "recording_text.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace handway::device {
namespace {

constexpr int kReadableByAll = 0666;  // less the umask

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw geometric::InputError({file.string(), "", std::strerror(error), "a file to write to",
                               "Check the folder, its permissions and the room on the disk"});
}

int open_anew(const std::filesystem::path& file) {
  const int number =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, kReadableByAll);
  if (number < 0) {
    fail(file, errno);
  }
  return number;
}

template <typename Values>
std::vector<double> selected(const Values& all, const std::vector<int>& sensors) {
  std::vector<double> values;
  values.reserve(sensors.size());
  for (const int sensor : sensors) {
    values.push_back(static_cast<double>(all.at(static_cast<std::size_t>(sensor))));
  }
  return values;
}

}  // namespace

RecordingWriter::Descriptor::~Descriptor() {
  if (number_ >= 0) {
    ::close(number_);
  }
}

RecordingWriter::Descriptor::Descriptor(Descriptor&& other) noexcept
    : number_(std::exchange(other.number_, -1)) {}

RecordingWriter::RecordingWriter(const std::filesystem::path& file, RecordingHeader header)
    : file_(file), header_(std::move(header)), descriptor_(open_anew(file)) {
  write(header_text(header_));
}

void RecordingWriter::append(double time, std::span<const double> values) {
  if (rows_ > 0 && time < last_time_) {
    throw std::invalid_argument("time runs backwards in a recording");
  }
  write(row_text(header_, time, values));
  last_time_ = time;
  ++rows_;
}

void RecordingWriter::append(const GloveFrame& frame) {
  append(frame.time, selected(frame.counts, header_.sensors));
}

void RecordingWriter::append(const GloveAngles& angles) {
  append(angles.time, selected(angles.angles, header_.sensors));
}

void RecordingWriter::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_.number(), text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      fail(file_, errno);
    }
    text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
  }
}

}  // namespace handway::device
