#pragma once

#include "handway/device/glove/recording_writer.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace handway::gui {

/// Writes the frames that pass by into a recording, row by row as they come, while it is
/// switched on. For any thread.
class RecordingTap {
 public:
  /// Begins a file anew.
  /// @throws geometric::InputError if it can't be written.
  void begin(const std::filesystem::path& file, device::RecordingHeader header);
  /// Closes the file.
  void end();

  void take(const device::GloveFrame& frame);

  [[nodiscard]] bool is_on() const;
  [[nodiscard]] std::size_t rows() const;
  /// From the first row to the last, s.
  [[nodiscard]] double duration() const;
  /// Why rows could not be written; empty if all were.
  [[nodiscard]] std::string error() const;

 private:
  mutable std::mutex mutex_;
  std::unique_ptr<device::RecordingWriter> writer_;
  std::size_t rows_ = 0;
  double first_ = 0.0;
  double last_ = 0.0;
  std::string error_;
};

}  // namespace handway::gui
