#pragma once

#include "handway/device/emulators/tracker_units.h"

#include <string>

namespace handway::device {

/// Common parts of emulated trackers: commands that are one letter or a line, and frames of all
/// sensors at a steady pace.
class TrackerUnit : public DeviceUnit {
 public:
  [[nodiscard]] Bytes receive(std::span<const std::uint8_t> bytes, double now) override;
  [[nodiscard]] std::vector<Bytes> advance(double now) override;
  [[nodiscard]] std::optional<double> next_due() const override;
  void set_plugged(bool plugged) override { plugged_ = plugged; }

 protected:
  /// @throws std::invalid_argument if the settings are out of range.
  TrackerUnit(const TrackerUnitSettings& settings, TrackerSignal signal, int most_sensors);

  /// @param frames_per_second of all sensors each.
  void begin_stream(double now, double frames_per_second);
  void end_stream() { streaming_ = false; }

  /// The records of all sensors, none if they are unplugged.
  [[nodiscard]] Bytes frame(double now);

  [[nodiscard]] const TrackerUnitSettings& settings() const { return settings_; }
  [[nodiscard]] bool plugged() const { return plugged_; }
  [[nodiscard]] bool streaming() const { return streaming_; }
  [[nodiscard]] geometric::Pose pose(double time, int sensor) const {
    return signal_(time, sensor);
  }
  /// State of the first sensor's button, if it has one.
  [[nodiscard]] bool pressed(double time, int sensor) const;

 private:
  /// Returns whether `command`, the characters since the last one, is complete.
  [[nodiscard]] virtual bool is_whole(const std::string& command) const = 0;
  /// @returns the answer.
  virtual Bytes obey(const std::string& command, double now) = 0;
  /// One record of one sensor, from 1.
  virtual Bytes record(double time, int sensor) = 0;

  TrackerUnitSettings settings_;
  TrackerSignal signal_;
  std::string command_;  ///< Taken so far, incomplete.
  bool streaming_ = false;
  bool plugged_ = true;
  double period_ = 0.0;
  double next_frame_ = 0.0;
};

/// Appends numbers in the devices' format.
void append_u16(DeviceUnit::Bytes& bytes, std::uint16_t value);
void append_u32(DeviceUnit::Bytes& bytes, std::uint32_t value);
void append_float(DeviceUnit::Bytes& bytes, double value);
void append_text(DeviceUnit::Bytes& bytes, std::string_view text);

/// Azimuth, elevation and roll of a rotation, deg.
[[nodiscard]] Eigen::Vector3d azimuth_elevation_roll(const Eigen::Matrix3d& R);
/// w, x, y, z with w ≥ 0.
[[nodiscard]] Eigen::Vector4d scalar_first(const Eigen::Matrix3d& R);
/// The numbers between commas from `at` on, up to the first that is not a number.
[[nodiscard]] std::vector<int> comma_list(std::string_view text);

}  // namespace handway::device
