#include "polhemus_items.h"

#include "handway/geometric/math/units.h"

#include <bit>
#include <cmath>

namespace handway::device {

namespace {

// Range beyond all magnetic trackers, m.
constexpr double kFarthest = 10.0;
// Tolerance of a unit quaternion rounded to four decimals; random bytes hardly ever meet it.
constexpr double kNormTolerance = 1e-3;
// Angles are rounded: those at the end of their range may be slightly beyond it, deg.
constexpr double kAngleTolerance = 0.01;

bool may_be_true(const Eigen::Vector3d& position) {
  return position.allFinite() && position.norm() <= kFarthest;
}

}  // namespace

std::span<const std::uint8_t> LittleEndianReader::take(std::size_t count) {
  const auto taken = bytes_.first(count);
  bytes_ = bytes_.subspan(count);
  return taken;
}

std::uint32_t LittleEndianReader::take_u32() {
  std::uint32_t value = 0;
  unsigned shift = 0;
  for (const std::uint8_t byte : take(4)) {
    value |= static_cast<std::uint32_t>(byte) << shift;
    shift += 8;
  }
  return value;
}

float LittleEndianReader::take_float() { return std::bit_cast<float>(take_u32()); }

Eigen::Vector3d LittleEndianReader::take_vector() {
  Eigen::Vector3d v;
  for (double& x : v) {
    x = take_float();
  }
  return v;
}

Eigen::Vector4d LittleEndianReader::take_four() {
  Eigen::Vector4d v;
  for (double& x : v) {
    x = take_float();
  }
  return v;
}

std::optional<geometric::Pose> pose_from_angles(const Eigen::Vector3d& position,
                                                const Eigen::Vector3d& angles) {
  const Eigen::Array3d range(180.0, 90.0, 180.0);
  if (!may_be_true(position) || !angles.allFinite() ||
      (angles.array().abs() > range + kAngleTolerance).any()) {
    return std::nullopt;
  }
  const Eigen::Vector3d radians = angles * geometric::kDegree;
  return geometric::pose_from_rpy(position, radians[2], radians[1], radians[0]);
}

std::optional<geometric::Pose> pose_from_quaternion(const Eigen::Vector3d& position,
                                                    const Eigen::Vector4d& wxyz) {
  if (!may_be_true(position) || !wxyz.allFinite() || std::abs(wxyz.norm() - 1.0) > kNormTolerance) {
    return std::nullopt;
  }
  geometric::Pose X = geometric::Pose::Identity();
  X.translation() = position;
  X.linear() =
      Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  return X;
}

std::optional<geometric::Pose> PoseItems::pose() const {
  if (!position_ || !(angles_ || quaternion_)) {
    return std::nullopt;
  }
  return quaternion_ ? pose_from_quaternion(*position_, *quaternion_)
                     : pose_from_angles(*position_, *angles_);
}

}  // namespace handway::device
