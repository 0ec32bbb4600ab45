#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_frame.h"
#include "handway/device/glove/recording.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace handway::device {

/// Writes a recording while it is made. Every row is handed to the system whole before
/// append() returns: a program that is killed loses no row that it has appended.
/// For one thread at a time.
class HANDWAY_DEVICE_EXPORT RecordingWriter {
 public:
  /// Starts the file again.
  /// @throws geometric::InputError if it can't be written.
  /// @throws std::invalid_argument for a sensor that isn't there, or one twice.
  RecordingWriter(const std::filesystem::path& file, RecordingHeader header);

  /// @param time s since the recording began, not below that of the row before.
  /// @param values counts or rad, finite, shape [sensors].
  /// @throws geometric::InputError if the row can't be written (a full disk).
  /// @throws std::invalid_argument if the shape differs, a value isn't finite or time
  /// runs backwards.
  void append(double time, std::span<const double> values);
  /// The header's sensors of a frame. @pre the header's kind is kCounts.
  void append(const GloveFrame& frame);
  /// The header's sensors of a frame. @pre the header's kind is kAngles.
  void append(const GloveAngles& angles);

  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  // An open file, closed with the object.
  class Descriptor {
   public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&&) = delete;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }

   private:
    int number_;
  };

  void write(std::string_view text) const;

  std::filesystem::path file_;
  RecordingHeader header_;
  Descriptor descriptor_;
  double last_time_ = 0.0;
  std::size_t rows_ = 0;
};

}  // namespace handway::device
