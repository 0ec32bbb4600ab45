#include "handway/device/glove/hand_mapper.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace handway::device {
namespace {

using geometric::InputError;
using geometric::RobotModel;

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

int variable_of(const RobotModel& hand, const JointWire& wire, const HandMapping& mapping) {
  const std::optional<int> variable = hand.find_variable(wire.joint);
  if (!variable) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(hand.variable_count()));
    for (int i = 0; i < hand.variable_count(); ++i) {
      names.push_back(hand.variable(i).name);
    }
    throw InputError({"mapping for " + mapping.hand, "joint " + wire.joint,
                      "no independent joint of " + hand.name(), "one of its joints",
                      geometric::advise_name(wire.joint, names)});
  }
  return *variable;
}

void check_complete(const RobotModel& hand, const HandMapping& mapping) {
  if (hand.name() != mapping.hand) {
    return;
  }
  for (int i = 0; i < hand.variable_count(); ++i) {
    const std::string& name = hand.variable(i).name;
    if (std::ranges::find(mapping.wires, name, &JointWire::joint) == mapping.wires.end()) {
      throw InputError({"mapping for " + mapping.hand, "", "nothing for joint " + name,
                        "a sensor for it, or \"fixed: middle\"", ""});
    }
  }
}

}  // namespace

HandMapper::HandMapper(const HandMapping& mapping, const RobotModel& hand) {
  check_complete(hand, mapping);
  std::map<int, const JointWire*> by_variable;
  for (const JointWire& wire : mapping.wires) {
    by_variable[variable_of(hand, wire, mapping)] = &wire;
  }
  const auto count = static_cast<Eigen::Index>(by_variable.size());
  lower_.resize(count);
  upper_.resize(count);
  for (const auto& [variable, wire] : by_variable) {
    const auto i = static_cast<Eigen::Index>(joints_.size());
    lower_[i] = hand.lower()[variable];
    upper_[i] = hand.upper()[variable];
    joints_.push_back(wire->joint);
    wires_.push_back(*wire);
  }
}

std::vector<bool> HandMapper::driven() const {
  std::vector<bool> result;
  result.reserve(wires_.size());
  for (const JointWire& wire : wires_) {
    result.push_back(wire.sensor >= 0);
  }
  return result;
}

double HandMapper::value(Eigen::Index joint, double angle) const {
  const JointWire& wire = wires_[static_cast<std::size_t>(joint)];
  const double middle = 0.5 * (lower_[joint] + upper_[joint]);
  if (wire.sensor < 0) {
    return wire.fixed.value_or(middle);
  }
  if (!std::isfinite(angle)) {
    return middle;
  }
  return wire.curve.empty() ? wire.gain * angle + wire.offset : on_curve(wire.curve, angle);
}

Eigen::VectorXd HandMapper::posture(const GloveAngles& angles) const {
  return unclamped(angles).cwiseMax(lower_).cwiseMin(upper_);
}

Eigen::VectorXd HandMapper::unclamped(const GloveAngles& angles) const {
  Eigen::VectorXd result(lower_.size());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    const int sensor = wires_[static_cast<std::size_t>(j)].sensor;
    const double angle = sensor < 0 ? 0.0 : angles.angles.at(static_cast<std::size_t>(sensor));
    result[j] = value(j, angle);
  }
  return result;
}

MappedPostures HandMapper::map_recording(const Recording& recording) const {
  if (recording.header.kind != RecordingKind::kAngles) {
    throw InputError({"recording", "", "raw counts", "angles", "Give a calibration of the glove"});
  }
  MappedPostures result;
  result.joints = joints_;
  result.unclamped.resize(recording.values.rows(), lower_.size());
  result.postures.resize(recording.values.rows(), lower_.size());
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    const JointWire& wire = wires_[static_cast<std::size_t>(j)];
    const int column = wire.sensor < 0 ? -1 : column_of(recording.header, wire.sensor);
    if (wire.sensor >= 0 && column < 0) {
      const auto sensor = static_cast<std::size_t>(wire.sensor);
      throw InputError({"recording", "",
                        fmt::format("no sensor {}", cyberglove_sensors()[sensor].name),
                        "it, to drive joint " + wire.joint,
                        "Wire the joint to another sensor in the mapping, or fix it there"});
    }
    for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
      result.unclamped(row, j) = value(j, column < 0 ? 0.0 : recording.values(row, column));
    }
    const auto all = result.unclamped.col(j).array();
    result.postures.col(j) = all.max(lower_[j]).min(upper_[j]);
    result.clamped.push_back((all < lower_[j] || all > upper_[j]).count());
  }
  return result;
}

}  // namespace handway::device
