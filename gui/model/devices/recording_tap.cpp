#include "model/devices/recording_tap.h"

#include <exception>

namespace handway::gui {

void RecordingTap::begin(const std::filesystem::path& file, device::RecordingHeader header) {
  auto writer = std::make_unique<device::RecordingWriter>(file, std::move(header));
  const std::lock_guard lock(mutex_);
  writer_ = std::move(writer);
  rows_ = 0;
  first_ = last_ = 0.0;
  error_.clear();
}

void RecordingTap::end() {
  const std::lock_guard lock(mutex_);
  writer_.reset();
}

void RecordingTap::take(const device::GloveFrame& frame) {
  const std::lock_guard lock(mutex_);
  if (!writer_) {
    return;
  }
  device::GloveFrame row = frame;
  if (rows_ == 0) {
    first_ = frame.time;
  }
  row.time -= first_;
  try {
    writer_->append(row);
    last_ = frame.time;
    ++rows_;
  } catch (const std::exception& error) {
    error_ = error.what();
    writer_.reset();
  }
}

bool RecordingTap::is_on() const {
  const std::lock_guard lock(mutex_);
  return writer_ != nullptr;
}

std::size_t RecordingTap::rows() const {
  const std::lock_guard lock(mutex_);
  return rows_;
}

double RecordingTap::duration() const {
  const std::lock_guard lock(mutex_);
  return last_ - first_;
}

std::string RecordingTap::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

}  // namespace handway::gui
