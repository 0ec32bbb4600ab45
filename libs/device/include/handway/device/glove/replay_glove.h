#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/recording.h"

#include <memory>
#include <string>

namespace handway::device {

/// Settings of the replay of a recording.
struct ReplaySettings {
  double speed = 1.0;  ///< Relative speed, > 0; infinity: as fast as it is read.
  bool loop = false;   ///< Restart at the end.
};

/// A glove that plays a recording. Frames come when they are due, stamped with their due time: a
/// delayed reader gets those that it missed at once. Angles become counts by typical_calibration();
/// it has 18 sensors if the four that such gloves lack are missing, else 22 (other missing ones
/// read 128).
class HANDWAY_DEVICE_EXPORT ReplayGlove final : public Glove {
 public:
  /// @param name of the recording, for GloveInfo.
  /// @throws geometric::InputError if the recording has no rows; std::invalid_argument if the
  /// speed isn't above 0.
  ReplayGlove(const Recording& recording, std::string name, const ReplaySettings& settings = {});
  ~ReplayGlove() override;

 private:
  struct Player;

  GloveInfo do_connect(const std::stop_token& stop) override;
  GloveReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) override;
  void do_disconnect() noexcept override {}

  std::unique_ptr<const Player> player_;
  std::string name_;
  ReplaySettings settings_;
  int sensors_;
  SensorIndices angle_sensors_;  ///< Sensors of a recording of angles.
  double begin_ = 0.0;           ///< Start of this round of the recording, s.
  std::size_t next_ = 0;
};

}  // namespace handway::device
