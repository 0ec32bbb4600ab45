#pragma once

#include "handway/geometric/math/pose.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace handway::device {

enum class PolhemusRecordKind {
  kPose,      ///< Where a station was.
  kDoubtful,  ///< A pose that the device marks as bad: distorted, or out of the field.
  kReply,     ///< An answer to another command: a sign of life.
};

/// One record from a Polhemus tracker.
struct PolhemusRecord {
  PolhemusRecordKind kind = PolhemusRecordKind::kPose;
  int station = 0;                                     ///< From 1.
  char command = 0;                                    ///< Of kReply: the command it answers.
  char error = ' ';                                    ///< Of kDoubtful: the device's letter.
  geometric::Pose X_ST = geometric::Pose::Identity();  ///< Of kPose: sensor in source frame, m.
  std::optional<bool> button;                          ///< Of kPose, if in the output list.
  std::optional<double> unit_time;  ///< Of kPose, if in the output list: the unit's clock, s.
  std::vector<std::uint8_t> body;   ///< Of kReply.
};

}  // namespace handway::device
