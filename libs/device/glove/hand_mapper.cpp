#include "handway/device/glove/hand_mapper.h"

#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/composed_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;
using geometric::RobotModel;

constexpr double kLeastRange = 1e-4;  // rad or m, of a joint that moves
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double on_curve(const std::vector<CurvePoint>& curve, double angle) {
  if (angle <= curve.front().angle) {
    return curve.front().joint;
  }
  const auto above = std::ranges::upper_bound(curve, angle, {}, &CurvePoint::angle);
  if (above == curve.end()) {
    return curve.back().joint;
  }
  const CurvePoint& below = *(above - 1);
  return std::lerp(below.joint, above->joint, (angle - below.angle) / (above->angle - below.angle));
}

int variable_of(const RobotModel& hand, const JointMapping& mapped, const HandMapping& mapping) {
  const std::optional<int> variable = geometric::find_variable_of_part(hand, mapped.joint);
  if (!variable) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(hand.variable_count()));
    for (int i = 0; i < hand.variable_count(); ++i) {
      names.push_back(hand.variable(i).name);
    }
    throw InputError({"mapping for " + mapping.hand, "joint " + mapped.joint,
                      "no independent joint of " + hand.name(), "one of its joints",
                      geometric::advise_name(mapped.joint, names)});
  }
  return *variable;
}

void check_complete(const RobotModel& hand, const HandMapping& mapping) {
  for (int i = 0; i < hand.variable_count(); ++i) {
    const std::string& name = hand.variable(i).name;
    if (hand.upper()[i] - hand.lower()[i] < kLeastRange) {
      continue;  // it can't move, as if it were fixed
    }
    if (std::ranges::find(mapping.joints, name, &JointMapping::joint) == mapping.joints.end()) {
      throw InputError({"mapping for " + mapping.hand, "", "nothing for joint " + name,
                        "a sensor for it, or \"fixed: middle\"", ""});
    }
  }
}

/// Many gloves, cameras and headsets don't measure palm and wrist.
bool is_of_fingers(int sensor) {
  const SensorIndices fingers = landmark_sensors();
  return std::ranges::find(fingers, sensor) != fingers.end();
}

}  // namespace

HandMapper::HandMapper(const HandMapping& mapping, const RobotModel& hand, bool is_hand,
                       const PersonRanges& ranges)
    : ranges_(ranges) {
  if (is_hand || hand.name() == mapping.hand) {
    check_complete(hand, mapping);
  }
  std::map<int, const JointMapping*> by_variable;
  for (const JointMapping& mapped : mapping.joints) {
    const int variable = variable_of(hand, mapped, mapping);
    if (!mapped.left_to_arm) {
      by_variable[variable] = &mapped;
    }
  }
  if (by_variable.empty()) {
    throw InputError({"mapping for " + mapping.hand, "joints", "all of them left to the arm",
                      "joints of the hand", ""});
  }
  const auto count = static_cast<Eigen::Index>(by_variable.size());
  lower_.resize(count);
  upper_.resize(count);
  for (const auto& [variable, mapped] : by_variable) {
    const auto i = static_cast<Eigen::Index>(joints_.size());
    lower_[i] = hand.lower()[variable];
    upper_[i] = hand.upper()[variable];
    joints_.push_back(mapped->joint);
    mappings_.push_back(*mapped);
  }
}

std::vector<bool> HandMapper::driven() const {
  std::vector<bool> result;
  result.reserve(mappings_.size());
  for (const JointMapping& mapped : mappings_) {
    result.push_back(mapped.sensor >= 0);
  }
  return result;
}

double HandMapper::value(Eigen::Index joint, double angle) const {
  const JointMapping& mapped = mappings_[static_cast<std::size_t>(joint)];
  const double middle = 0.5 * (lower_[joint] + upper_[joint]);
  if (mapped.sensor < 0) {
    return mapped.fixed.value_or(middle);
  }
  if (!std::isfinite(angle)) {
    return middle;
  }
  const double typical = typical_angle(ranges_, mapped.sensor, angle);
  return mapped.curve.empty() ? mapped.gain * typical + mapped.offset
                              : on_curve(mapped.curve, typical);
}

Eigen::VectorXd HandMapper::posture(const GloveAngles& angles) const {
  return unclamped(angles).cwiseMax(lower_).cwiseMin(upper_);
}

Eigen::VectorXd HandMapper::unclamped(const GloveAngles& angles) const {
  Eigen::VectorXd result(lower_.size());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    const int sensor = mappings_[static_cast<std::size_t>(j)].sensor;
    const double angle = sensor < 0 ? 0.0 : angles.angles.at(static_cast<std::size_t>(sensor));
    result[j] = value(j, angle);
  }
  return result;
}

MappedPostures HandMapper::map_recording(const Recording& recording,
                                         const std::stop_token& /*stop*/) const {
  if (recording.header.kind != RecordingKind::kAngles) {
    throw InputError({"recording", "", "raw counts", "angles", "Give a calibration of the glove"});
  }
  Eigen::MatrixXd unclamped(recording.values.rows(), lower_.size());
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    const JointMapping& mapped = mappings_[static_cast<std::size_t>(j)];
    const int column = mapped.sensor < 0 ? -1 : column_of(recording.header, mapped.sensor);
    if (mapped.sensor >= 0 && column < 0 && is_of_fingers(mapped.sensor)) {
      const auto sensor = static_cast<std::size_t>(mapped.sensor);
      throw InputError({"recording", "",
                        fmt::format("no sensor {}", cyberglove_sensors()[sensor].name),
                        "it, to drive joint " + mapped.joint,
                        "Wire the joint to another sensor in the mapping, or fix it there"});
    }
    for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
      unclamped(row, j) = value(j, column < 0 ? kNaN : recording.values(row, column));
    }
  }
  return within_limits(std::move(unclamped));
}

}  // namespace handway::device
