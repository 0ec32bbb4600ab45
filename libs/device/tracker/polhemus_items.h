#pragma once

#include "handway/geometric/math/pose.h"

#include <cstdint>
#include <optional>
#include <span>

namespace handway::device {

inline constexpr double kMetresPerInch = 0.0254;
inline constexpr double kMetresPerCentimetre = 0.01;

/// Takes little-endian numbers from the front of a record. @pre there are enough bytes.
class LittleEndianReader {
 public:
  explicit LittleEndianReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::span<const std::uint8_t> take(std::size_t count);
  std::uint32_t take_u32();
  float take_float();
  Eigen::Vector3d take_vector();
  Eigen::Vector4d take_four();

 private:
  std::span<const std::uint8_t> bytes_;
};

/// The pose of a record's position and orientation.
/// @param orientation azimuth, elevation and roll (deg), or a quaternion w, x, y, z.
/// @returns nothing if a number is impossible: not finite, beyond 10 m, beyond an angle's range, no
/// unit quaternion.
[[nodiscard]] std::optional<geometric::Pose> pose_from_angles(const Eigen::Vector3d& position,
                                                              const Eigen::Vector3d& angles);
[[nodiscard]] std::optional<geometric::Pose> pose_from_quaternion(const Eigen::Vector3d& position,
                                                                  const Eigen::Vector4d& wxyz);

/// Position and orientation of a record, in any order of its items.
class PoseItems {
 public:
  /// @param position m.
  void set_position(const Eigen::Vector3d& position) { position_ = position; }
  /// @param angles azimuth, elevation, roll, deg.
  void set_angles(const Eigen::Vector3d& angles) { angles_ = angles; }
  void set_quaternion(const Eigen::Vector4d& wxyz) { quaternion_ = wxyz; }

  /// @returns nothing if a number is impossible; the quaternion takes precedence over the angles.
  [[nodiscard]] std::optional<geometric::Pose> pose() const;

 private:
  std::optional<Eigen::Vector3d> position_;
  std::optional<Eigen::Vector3d> angles_;
  std::optional<Eigen::Vector4d> quaternion_;
};

}  // namespace handway::device
